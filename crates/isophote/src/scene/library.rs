//! The starter scenes built into the program, identical to the files in `scenes/`.

pub use crate::text::Language;
use crate::units::Keyword;

/// A scene to start from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Starter {
    /// One sphere, one light: the lab's scene, rendered if no other is named.
    Lab,
    /// Millimetres and Lambertian lights.
    Course,
    /// The course's sphere below a screen in the plane z = 0.
    CourseSphere,
    /// The course's plane under a lamp, with a circle of interest.
    CoursePlane,
    /// Two spheres, two lights, physically normalised radiance.
    TwoLights,
    /// Candela, lux and cd/m².
    Photometric,
}

impl Keyword for Starter {
    const ALL: &'static [Self] =
        &[Self::Lab, Self::Course, Self::CourseSphere, Self::CoursePlane, Self::TwoLights, Self::Photometric];

    fn name(self) -> &'static str {
        match self {
            Self::Lab => "lab",
            Self::Course => "course",
            Self::CourseSphere => "course-sphere",
            Self::CoursePlane => "course-plane",
            Self::TwoLights => "two-lights",
            Self::Photometric => "photometric",
        }
    }
}

impl Starter {
    /// The scene file with its comments in English.
    #[must_use]
    pub fn text(self) -> &'static str {
        self.text_in(Language::English)
    }

    /// The scene file with its comments and its title in a language; otherwise they are the same.
    #[must_use]
    pub fn text_in(self, language: Language) -> &'static str {
        let [english, russian] = match self {
            Self::Lab => [include_str!("../../../../scenes/lab.toml"), include_str!("../../../../scenes/ru/lab.toml")],
            Self::Course => {
                [include_str!("../../../../scenes/course.toml"), include_str!("../../../../scenes/ru/course.toml")]
            }
            Self::CourseSphere => [
                include_str!("../../../../scenes/course-sphere.toml"),
                include_str!("../../../../scenes/ru/course-sphere.toml"),
            ],
            Self::CoursePlane => [
                include_str!("../../../../scenes/course-plane.toml"),
                include_str!("../../../../scenes/ru/course-plane.toml"),
            ],
            Self::TwoLights => [
                include_str!("../../../../scenes/two-lights.toml"),
                include_str!("../../../../scenes/ru/two-lights.toml"),
            ],
            Self::Photometric => [
                include_str!("../../../../scenes/photometric.toml"),
                include_str!("../../../../scenes/ru/photometric.toml"),
            ],
        };
        match language {
            Language::English => english,
            Language::Russian => russian,
        }
    }
}
