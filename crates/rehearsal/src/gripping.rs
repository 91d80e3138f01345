//! Grasping and releasing in a flight.

use crate::true_plant::TruePlant;
use wrasse_dynamics::Frame;
use wrasse_world::{GraspRefused, GripOffset};

impl TruePlant<'_> {
    /// Grasp a payload within these bounds; what to say of it, or why it is refused.
    pub(crate) fn grasp(
        &mut self,
        tool: &Frame<f64>,
        i: usize,
        most: Option<GripOffset>,
    ) -> Result<String, String> {
        let most = most.ok_or("the step allows no grasp")?;
        let name = &self.case.payloads[i].name;
        let held_already = || format!("{name} does not float: it is held already");
        let found = self.world.grip_offset(tool, i).ok_or_else(held_already)?;
        let guided = self.case.frame_name(tool);
        let change = self
            .world
            .grasp(tool, i, &most)
            .map_err(|GraspRefused(found)| refusal(name, guided, &found, &most))?
            .ok_or_else(held_already)?;
        Ok(format!(
            "grasped {name}: its grip {:.2} mm and {:.3} deg from the tool {guided} (at most {} mm and {} deg); \
             energy changes by {change:.3e} J",
            found.distance * 1e3,
            found.angle.to_degrees(),
            short(most.distance * 1e3),
            short(most.angle.to_degrees())
        ))
    }

    /// Let go of a payload; what to say of it, or why it cannot be.
    pub(crate) fn release(&mut self, i: usize) -> Result<String, String> {
        let name = &self.case.payloads[i].name;
        if !self.world.release(i) {
            return Err(format!("{name} cannot be released: nobody holds it"));
        }
        Ok(format!("released {name}"))
    }
}

/// Why a grasp by a tool is refused, with the numbers against their bounds.
pub(crate) fn refusal(payload: &str, tool: &str, found: &GripOffset, most: &GripOffset) -> String {
    let each = [
        ("distance of grip and tool", found.distance * 1e3, most.distance * 1e3, "mm"),
        ("angle", found.angle.to_degrees(), most.angle.to_degrees(), "deg"),
        ("relative speed", found.linear_speed, most.linear_speed, "m/s"),
        (
            "relative turning speed",
            found.angular_speed.to_degrees(),
            most.angular_speed.to_degrees(),
            "deg/s",
        ),
    ];
    let parts = each.map(|(what, found, most, unit)| {
        let beyond = if found <= most { "" } else { ", beyond it" };
        format!("{what} {found:.4} {unit} (at most {} {unit}{beyond})", short(most))
    });
    format!("grasp of {payload} by the tool {tool} refused: {}", parts.join(", "))
}

/// A bound as its file has it: without the round-off of its unit.
fn short(x: f64) -> f64 {
    (x * 1e9).round() / 1e9
}
