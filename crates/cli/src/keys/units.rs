//! The unit of a number, from the end of its key.

/// Ends of keys and their units, the longer before the shorter.
const UNITS: [(&str, &str); 35] = [
    ("_deg_h_sqrt_h", "deg/h/√h"),
    ("_deg_sqrt_h", "deg/√h"),
    ("_kg_m3", "kg/m³"),
    ("_kgm2", "kg·m²"),
    ("_nm_rad", "N·m/rad"),
    ("_rad_s", "rad/s"),
    ("_deg_s", "deg/s"),
    ("_deg_s2", "deg/s²"),
    ("_deg_s3", "deg/s³"),
    ("_deg_h", "deg/h"),
    ("_mm_s", "mm/s"),
    ("_m_s", "m/s"),
    ("_m_s2", "m/s²"),
    ("_m_s3", "m/s³"),
    ("_per_s", "1/s"),
    ("_nms_rad", "N·m·s/rad"),
    ("_nms", "N·m·s"),
    ("_nm", "N·m"),
    ("_n", "N"),
    ("_percent", "%"),
    ("_arcsec", "arcsec"),
    ("_rpm", "rpm"),
    ("_hz", "Hz"),
    ("_kg", "kg"),
    ("_deg", "deg"),
    ("_rad", "rad"),
    ("_mm", "mm"),
    ("_cm", "cm"),
    ("_m", "m"),
    ("_ms", "ms"),
    ("_s", "s"),
    ("_h", "h"),
    ("_w", "W"),
    ("_j", "J"),
    ("_min", "min"),
];

/// The unit of the number with this key: by its end, else by that of the table in which it stands.
pub(super) fn unit(key: &str, table: &str) -> &'static str {
    by_end(key).or_else(|| by_end(table)).unwrap_or("–")
}

/// By the longest end that fits.
fn by_end(key: &str) -> Option<&'static str> {
    let fits = UNITS.iter().filter(|(end, _)| key.ends_with(end));
    fits.max_by_key(|(end, _)| end.len()).map(|(_, unit)| *unit)
}

#[cfg(test)]
mod tests {
    use super::unit;

    #[test]
    fn the_end_of_a_key_says_the_unit() {
        for (key, table, expected) in [
            ("turn_jerk_deg_s3", "limits", "deg/s³"),
            ("viscous_friction_nms", "wheel", "N·m·s"),
            ("xx", "inertia_kgm2", "kg·m²"),
            ("gain_per_s", "", "1/s"),
            ("joint_damping_ratio", "control", "–"),
            ("stiffness_nm_rad", "slosh", "N·m/rad"),
        ] {
            assert_eq!(unit(key, table), expected, "{key}");
        }
    }
}
