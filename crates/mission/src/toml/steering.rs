//! `[control.steering]`: from a wanted torque to what each actuator is told.

use crate::reading::Reading;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use wrasse_document::Step;
use wrasse_flight::allocation::{
    AllocationSetup, CmgLaw, CmgSharing, Damping, Desaturation, Modulation, Waves, WheelLaw,
    WheelSharing,
};
use wrasse_spatial::Vec3;

/// How the wheels share a torque.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Deserialize, JsonSchema, Serialize)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum WheelLawFile {
    /// Least sum of squares of the motor torques.
    #[default]
    PseudoInverse,
    /// Least largest motor torque.
    MinimumPeak,
}

/// How the gimbals of the CMGs are turned.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Deserialize, JsonSchema, Serialize)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum CmgLawFile {
    /// Least gimbal rates: exact, and lost at a singular setting.
    PseudoInverse,
    /// Damped near singular settings: finite rates, but stuck on the internal ones.
    SingularityRobust,
    /// Damped with off-diagonal terms that shake the gimbals out of internal singular settings.
    #[default]
    GeneralizedSingularityRobust,
}

/// From a wanted torque to what each actuator is told.
#[derive(Debug, Clone, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields, default)]
pub(crate) struct SteeringFile {
    /// How the wheels share a torque.
    pub(crate) wheels: WheelLawFile,
    /// How fast wheel speeds are evened out where that gives no torque.
    pub(crate) wheel_null_gain_per_s: f64,
    /// How the gimbals are turned.
    #[schemars(extend("x-formerly" = ["gyros"]))]
    pub(crate) cmgs: CmgLawFile,
    /// How fast gimbals move away from singular settings where that gives no torque (rad/s for a unit
    /// slope of the singularity measure).
    #[schemars(extend("x-formerly" = ["gyro_null_gain_rad_s"]))]
    pub(crate) cmg_null_gain_rad_s: f64,
    /// Direction of the momentum that the CMGs will have to take up, base axes, of any length: gimbals
    /// start at angles that are searched for it, from which plain steering goes farthest without
    /// coming near a singular setting. They replace the angles of `[actuators]`.
    pub(crate) preferred_for: Option<[f64; 3]>,
    /// How thrusters are pulsed.
    pub(crate) modulation: ModulationFile,
    /// When thrusters empty wheels and CMGs.
    pub(crate) unloading: Option<UnloadingFile>,
}

impl Default for SteeringFile {
    fn default() -> Self {
        Self {
            wheels: WheelLawFile::default(),
            wheel_null_gain_per_s: 0.02,
            cmgs: CmgLawFile::default(),
            cmg_null_gain_rad_s: 0.02,
            preferred_for: None,
            modulation: ModulationFile::default(),
            unloading: None,
        }
    }
}

/// Pulse-width pulse-frequency modulation: a lag and a switch with hysteresis for each thruster.
#[derive(Debug, Clone, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields, default)]
pub(crate) struct ModulationFile {
    /// Gain before the lag.
    pub(crate) gain: f64,
    /// Time constant of the lag.
    pub(crate) lag_s: f64,
    /// The lag's output at which the thruster opens, as a share of full force.
    pub(crate) opens_at: f64,
    /// The lag's output at which it shuts.
    pub(crate) shuts_at: f64,
}

impl Default for ModulationFile {
    fn default() -> Self {
        Self { gain: 4.0, lag_s: 0.4, opens_at: 0.25, shuts_at: 0.05 }
    }
}

/// Thrusters take over what wheels and CMGs have stored.
#[derive(Debug, Clone, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct UnloadingFile {
    /// Stored momentum at which it begins.
    pub(crate) begins_at_nms: f64,
    /// Stored momentum at which it ends.
    pub(crate) ends_at_nms: f64,
    /// How fast: torque of the thrusters for each N·m·s stored.
    pub(crate) gain_per_s: f64,
}

/// The laws of the steering, for no actuators yet.
pub(crate) fn steering(r: &mut Reading<'_>, file: &SteeringFile) -> AllocationSetup<f64> {
    let path = |key| [Step::Key("control"), Step::Key("steering"), Step::Key(key)];
    let wheels = WheelLaw {
        sharing: match file.wheels {
            WheelLawFile::PseudoInverse => WheelSharing::PseudoInverse,
            WheelLawFile::MinimumPeak => WheelSharing::MinimumPeak,
        },
        null_gain: r.not_negative(&path("wheel_null_gain_per_s"), file.wheel_null_gain_per_s),
    };
    let null_gain = r.not_negative(&path("cmg_null_gain_rad_s"), file.cmg_null_gain_rad_s);
    // The numbers of the literature: Wie, Bailey, Heiberg 2001.
    let damping = Damping { k0: 0.01, fading: 10.0 };
    let quarter = std::f64::consts::FRAC_PI_2;
    let waves = Waves { height: 0.01, frequency: quarter, phases: [0.0, quarter, 2.0 * quarter] };
    let sharing = match file.cmgs {
        CmgLawFile::PseudoInverse => CmgSharing::PseudoInverse,
        CmgLawFile::SingularityRobust => CmgSharing::SingularityRobust(damping),
        CmgLawFile::GeneralizedSingularityRobust => {
            CmgSharing::GeneralizedSingularityRobust(damping, waves)
        }
    };
    let unloading = file.unloading.as_ref().map(|u| {
        let path = |key| {
            [Step::Key("control"), Step::Key("steering"), Step::Key("unloading"), Step::Key(key)]
        };
        if u.ends_at_nms >= u.begins_at_nms {
            let message = format!(
                "unloading would end at {} N·m·s, before it begins at {}",
                u.ends_at_nms, u.begins_at_nms
            );
            r.error(&path("ends_at_nms"), message, "let it end below where it begins");
        }
        Desaturation {
            target_B: Vec3::zero(),
            start: r.positive(&path("begins_at_nms"), u.begins_at_nms),
            stop: r.not_negative(&path("ends_at_nms"), u.ends_at_nms),
            gain: r.positive(&path("gain_per_s"), u.gain_per_s),
            active: false,
        }
    });
    AllocationSetup {
        actuators: wrasse_hardware::Actuators::default(),
        wheels,
        cmgs: CmgLaw { sharing, null_gain },
        modulation: modulation(r, file),
        holds_position: false,
        desaturation: unloading,
    }
}

fn modulation(r: &mut Reading<'_>, file: &SteeringFile) -> Modulation<f64> {
    let path = |key| {
        [Step::Key("control"), Step::Key("steering"), Step::Key("modulation"), Step::Key(key)]
    };
    let m = &file.modulation;
    if m.shuts_at >= m.opens_at {
        let message = format!("it opens at {} and would shut at {}", m.opens_at, m.shuts_at);
        r.error(&path("shuts_at"), message, "a thruster shuts below where it opens");
    }
    Modulation {
        gain: r.positive(&path("gain"), m.gain),
        lag: r.positive(&path("lag_s"), m.lag_s),
        on_level: r.positive(&path("opens_at"), m.opens_at),
        off_level: r.not_negative(&path("shuts_at"), m.shuts_at),
    }
}
