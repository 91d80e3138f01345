//! `[control.estimation]`: what estimates start from.

use crate::reading::Reading;
use crate::toml::MissionFile;
use crate::toml::pose::attitude;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use wrasse_document::{Step, at};
use wrasse_flight::{EstimatorSetup, NavigationSetup, TRACKER_MEMORY};
use wrasse_hardware::Sensors;
use wrasse_spatial::Quat;

/// What estimates start from.
#[derive(Debug, Clone, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields, default)]
pub(crate) struct EstimationFile {
    /// How well the attitude is known at the start (one sigma).
    pub(crate) attitude_sigma_deg: f64,
    /// How well the gyro's bias is known at the start (one sigma). The estimate starts at zero.
    pub(crate) bias_sigma_deg_h: f64,
    /// Bandwidth of the filters that make joint rates of encoder positions.
    pub(crate) joint_bandwidth_rad_s: f64,
}

impl Default for EstimationFile {
    fn default() -> Self {
        Self { attitude_sigma_deg: 0.01, bias_sigma_deg_h: 1.0, joint_bandwidth_rad_s: 60.0 }
    }
}

/// What the navigation must know.
pub(crate) fn navigation(
    r: &mut Reading<'_>,
    file: &MissionFile,
    sensors: Option<&Sensors<f64>>,
) -> NavigationSetup<f64> {
    let e = &file.control.estimation;
    let path = |key| [Step::Key("control"), Step::Key("estimation"), Step::Key(key)];
    let attitude_sigma = r.positive(&path("attitude_sigma_deg"), e.attitude_sigma_deg);
    let bias_sigma = r.positive(&path("bias_sigma_deg_h"), e.bias_sigma_deg_h);
    if let Some((_, tracker)) = sensors.and_then(|s| s.attitude) {
        check_latency(r, file, tracker.latency);
    }
    NavigationSetup {
        attitude: sensors.and_then(|s| s.attitude).map(|(gyro, tracker)| EstimatorSetup {
            gyro,
            tracker,
            start_attitude_sigma: attitude_sigma.to_radians(),
            start_bias_sigma: bias_sigma.to_radians() / 3600.0,
        }),
        joint_bandwidth: r.positive(&path("joint_bandwidth_rad_s"), e.joint_bandwidth_rad_s),
        quat_NB: Quat::from_matrix(&attitude(r, at!["initial", "attitude"], file.initial.attitude)),
    }
}

/// The estimator must reach back to when a star tracker's reading was taken.
fn check_latency(r: &mut Reading<'_>, file: &MissionFile, latency: f64) {
    let rate = file.control.rate_hz;
    let memory = TRACKER_MEMORY as f64 / rate;
    // Within round-off of the sum of periods, and for a rate that is one: any other is refused already.
    if latency <= memory * (1.0 + 1e-12) || rate.is_nan() || rate <= 0.0 {
        return;
    }
    let given = [Step::Key("sensors"), Step::Key("star_tracker"), Step::Key("latency_s")];
    let path = match &file.sensors {
        Some(_) if r.is_there(&given) => &given[..],
        Some(_) => &given[..2],
        None => at!["vehicle"],
    };
    let message = format!(
        "the star tracker's readings are {latency} s old, and the attitude estimator reaches back \
         {memory:.3} s: {TRACKER_MEMORY} control periods at {rate} Hz"
    );
    let slowest = TRACKER_MEMORY as f64 / latency;
    let help = format!(
        "it would refuse every reading: take a tracker that is faster, or control.rate_hz of at most \
         {slowest:.1}"
    );
    r.error(path, message, &help);
}
