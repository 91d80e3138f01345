//! Wheel allocation on random arrays: the sum, the limits, the least peak, even speeds.

mod arrays;
mod by_hand;
mod extremes;
mod random;
mod speed_limits;
