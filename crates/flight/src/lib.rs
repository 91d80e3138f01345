//! What would fly: guidance, inverse kinematics, arm and attitude control.
