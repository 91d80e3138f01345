//! CMG steering on the pyramid of four: printed formulas, the classic test, laws.

mod extremes;
mod preferred_angles;
mod pyramid;
mod rates;
mod singularities;
