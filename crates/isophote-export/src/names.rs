//! Names of channels inside files: a light's name may contain anything, but a format has its rules.

use std::collections::HashSet;

use isophote::map::{Channel, Quantity};

/// Leaves room for `light.`, a number and `.Y` in the 255 bytes allowed for an EXR channel name.
const LONGEST_LIGHT_NAME: usize = 200;

/// One name per channel: that of its quantity, in which every character of a light's name that is not `allowed` becomes
/// an underscore and an empty name becomes `unnamed`; duplicates are numbered from 2.
///
/// # Panics
/// Never: there is always another number.
#[must_use]
pub fn unique(channels: &[Channel], allowed: fn(char) -> bool) -> Vec<String> {
    let mut used = HashSet::new();
    let mut names = Vec::with_capacity(channels.len());
    for channel in channels {
        let plain = match &channel.quantity {
            Quantity::Light(light) => Quantity::Light(cleaned(light, allowed)).name(),
            Quantity::LightBrightness(light) => Quantity::LightBrightness(cleaned(light, allowed)).name(),
            other => other.name(),
        };
        let numbered = (2_u64..).map(|number| format!("{plain}_{number}"));
        let free = std::iter::once(plain.clone()).chain(numbered).find(|name| !used.contains(name));
        let name = free.expect("numbers do not run out");
        used.insert(name.clone());
        names.push(name);
    }
    names
}

fn cleaned(light: &str, allowed: fn(char) -> bool) -> String {
    let keep = |character| if allowed(character) { character } else { '_' };
    let mut name = String::new();
    for character in light.chars().map(keep) {
        if name.len() + character.len_utf8() > LONGEST_LIGHT_NAME {
            break;
        }
        name.push(character);
    }
    if name.is_empty() { "unnamed".into() } else { name }
}

#[cfg(test)]
mod tests {
    use super::*;
    use isophote::map::Values;

    fn named(lights: &[&str]) -> Vec<String> {
        let channel = |light: &&str| Channel {
            quantity: Quantity::Light((*light).into()),
            unit: "W/m²".into(),
            values: Values::Scalar(vec![]),
        };
        unique(&lights.iter().map(channel).collect::<Vec<_>>(), char::is_alphanumeric)
    }

    #[test]
    fn names_are_valid_and_differ_whatever_the_lights_are_called() {
        assert_eq!(
            named(&["лампа", "a.b", "a b", "a_b_2", ""]),
            ["light.лампа", "light.a_b", "light.a_b_2", "light.a_b_2_2", "light.unnamed"]
        );
    }

    #[test]
    fn long_names_are_cut_between_characters_and_stay_different() {
        let long = "я".repeat(300);
        let names = named(&[&long, &long]);
        assert_eq!(names, [format!("light.{}", "я".repeat(100)), format!("light.{}_2", "я".repeat(100))]);
    }
}
