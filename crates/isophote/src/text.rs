//! Numbers in readable form.

/// A number with this many significant digits, without trailing zeros; as a power of ten if it is very large or very small.
#[must_use]
pub fn significant(value: f64, digits: usize) -> String {
    if value == 0.0 {
        return "0".into();
    }
    let scientific = format!("{value:.*e}", digits - 1);
    let (mantissa, exponent) = scientific.split_once('e').unwrap_or((&scientific, "0"));
    let exponent: i32 = exponent.parse().unwrap_or(0);
    if !(-5..15).contains(&exponent) {
        return format!("{}e{exponent}", trimmed(mantissa));
    }
    let decimals = usize::try_from(i32::try_from(digits).unwrap_or(17) - 1 - exponent).unwrap_or(0);
    trimmed(&format!("{value:.decimals$}")).to_owned()
}

fn trimmed(number: &str) -> &str {
    if number.contains('.') { number.trim_end_matches('0').trim_end_matches('.') } else { number }
}

#[cfg(test)]
mod tests {
    use super::significant;

    #[test]
    fn numbers_have_the_digits_that_were_asked_for_and_no_more() {
        assert_eq!(significant(0.316_677_297_547_092_75, 15), "0.316677297547093");
        assert_eq!(significant(0.316_677_297_547_092_75, 4), "0.3167");
        assert_eq!(significant(-100.0, 12), "-100");
        assert_eq!(significant(0.999_999_99, 4), "1");
        assert_eq!(significant(123_456.789, 3), "123457");
        assert_eq!(significant(1.5e-9, 12), "1.5e-9");
        assert_eq!(significant(-2.5e20, 12), "-2.5e20");
        assert_eq!(significant(0.0, 12), "0");
    }
}
