//! Simulated truth: motion of the bodies, drives and actuators as they behave, the ledger.
