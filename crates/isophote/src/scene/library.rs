//! The starter scenes built into the program, identical to the files in `scenes/`.

use crate::units::Keyword;

/// A scene to start from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Starter {
    /// One sphere, one light: the lab's scene, rendered if no other is named.
    Lab,
    /// Millimetres and Lambertian lights.
    Course,
    /// Two spheres, two lights, physically normalised radiance.
    TwoLights,
    /// Candela, lux and cd/m².
    Photometric,
}

impl Keyword for Starter {
    const ALL: &'static [Self] = &[Self::Lab, Self::Course, Self::TwoLights, Self::Photometric];

    fn name(self) -> &'static str {
        match self {
            Self::Lab => "lab",
            Self::Course => "course",
            Self::TwoLights => "two-lights",
            Self::Photometric => "photometric",
        }
    }
}

impl Starter {
    /// The commented scene file.
    #[must_use]
    pub fn text(self) -> &'static str {
        match self {
            Self::Lab => include_str!("../../../../scenes/lab.toml"),
            Self::Course => include_str!("../../../../scenes/course.toml"),
            Self::TwoLights => include_str!("../../../../scenes/two-lights.toml"),
            Self::Photometric => include_str!("../../../../scenes/photometric.toml"),
        }
    }
}
