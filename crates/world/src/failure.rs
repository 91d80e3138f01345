//! Units that fail.

use crate::scene::{Scene, SystemId};
use crate::setup::BaseAttitude;

/// Something that breaks, from now on: a valve from the next command on.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Failure {
    /// The motor of this wheel gives nothing; the friction of its bearing stays.
    Wheel(usize),
    /// This gimbal is stuck.
    Gimbal(usize),
    /// This thruster stays shut.
    ThrusterShut(usize),
    /// This thruster stays open.
    ThrusterOpen(usize),
}

impl<const J: usize> Scene<J> {
    /// Let something of a system break. What there is not cannot break, and what does not act, on a base
    /// that is held, breaks unseen: nothing happens.
    ///
    /// # Panics
    /// If the system is part of another now.
    pub fn fail(&mut self, id: SystemId, failure: Failure) {
        if self.system(id).base == BaseAttitude::Held {
            return;
        }
        let before = self.state(id);
        let system = self.system_mut(id);
        let mut jolts = vec![];
        for (i, effector) in system.effectors.iter_mut().enumerate() {
            let own = system.variables.effector(i);
            let had = system.row[own.clone()].to_vec();
            if let Some(impulse_B) = effector.fail(failure, &mut system.row[own.clone()]) {
                jolts.push((impulse_B, effector.source()));
            }
            // What jumped has nothing to give back.
            for (at, had) in own.zip(had) {
                if system.row[at] != had {
                    system.carry[at] = 0.0;
                }
            }
        }
        for jolt in jolts {
            self.jolt(id.0, &before, jolt);
        }
    }
}
