//! `atlas-class` of the catalogue as a table.

use wrasse_flight_c::{WrasseBody, WrasseFrame, WrasseJoint, WrasseLink};

#[rustfmt::skip]
pub(crate) const BASE: WrasseBody = WrasseBody { mass: 1500.0, centre_of_mass: [0.0, 0.0, 0.0], inertia: [640.0, 725.0, 725.0, 0.0, 0.0, 0.0] };

#[rustfmt::skip]
pub(crate) const TOOL: WrasseFrame = WrasseFrame { link: 6, position: [0.2, 0.0, 0.0], rotation: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]] };

#[rustfmt::skip]
pub(crate) const LINKS: [WrasseLink; 7] = [
    WrasseLink { joint: WrasseJoint { parent: -1, sliding: 0, position: [0.9, 0.5, 0.0], rotation: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]], axis: [1.0, 0.0, 0.0] }, body: WrasseBody { mass: 10.0, centre_of_mass: [0.0, 0.0, 0.0], inertia: [0.018, 0.021, 0.021, 0.0, 0.0, 0.0] } },
    WrasseLink { joint: WrasseJoint { parent: 0, sliding: 0, position: [0.0, 0.0, 0.0], rotation: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]], axis: [0.0, 1.0, 0.0] }, body: WrasseBody { mass: 10.0, centre_of_mass: [0.05, 0.0, 0.0], inertia: [0.018, 0.020999999999999998, 0.020999999999999998, 0.0, 0.0, 0.0] } },
    WrasseLink { joint: WrasseJoint { parent: 1, sliding: 0, position: [0.0, 0.0, 0.0], rotation: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]], axis: [1.0, 0.0, 0.0] }, body: WrasseBody { mass: 8.0, centre_of_mass: [0.225, 0.0, 0.0], inertia: [0.0144, 0.1422, 0.1422, 0.0, 0.0, 0.0] } },
    WrasseLink { joint: WrasseJoint { parent: 2, sliding: 0, position: [0.45, 0.0, 0.0], rotation: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]], axis: [0.0, 1.0, 0.0] }, body: WrasseBody { mass: 8.0, centre_of_mass: [0.05, 0.0, 0.0], inertia: [0.0144, 0.016799999999999995, 0.016799999999999995, 0.0, 0.0, 0.0] } },
    WrasseLink { joint: WrasseJoint { parent: 3, sliding: 0, position: [0.0, 0.0, 0.0], rotation: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]], axis: [1.0, 0.0, 0.0] }, body: WrasseBody { mass: 6.0, centre_of_mass: [0.2, 0.0, 0.0], inertia: [0.0108, 0.08539999999999998, 0.08539999999999998, 0.0, 0.0, 0.0] } },
    WrasseLink { joint: WrasseJoint { parent: 4, sliding: 0, position: [0.4, 0.0, 0.0], rotation: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]], axis: [0.0, 1.0, 0.0] }, body: WrasseBody { mass: 6.0, centre_of_mass: [0.03, 0.0, 0.0], inertia: [0.0108, 0.0104, 0.0104, 0.0, 0.0, 0.0] } },
    WrasseLink { joint: WrasseJoint { parent: 5, sliding: 0, position: [0.0, 0.0, 0.0], rotation: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]], axis: [1.0, 0.0, 0.0] }, body: WrasseBody { mass: 8.0, centre_of_mass: [0.1, 0.0, 0.0], inertia: [0.0144, 0.03386666666666667, 0.03386666666666667, 0.0, 0.0, 0.0] } },
];
