//! Decimal numbers in text files: parsed fast and exactly, written so that nothing is lost.

use std::io::Write;

/// A finite number and, if its text is plain fixed-point, how many decimals that had.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Number {
    pub(crate) value: f64,
    /// `Some(d)` promises that writing `value` with `d` decimals gives back the same text.
    pub(crate) decimals: Option<u8>,
}

/// Reads a whole field as a finite number; `None` for anything else, NaN and infinity included.
pub(crate) fn parse(field: &[u8]) -> Option<Number> {
    parse_short(field).or_else(|| parse_any(field))
}

/// Fixed-point text of at most this many digits survives text -> f64 -> text.
const EXACT_DIGITS: usize = 15;

const POWERS: [f64; EXACT_DIGITS] = [
    1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14,
];

/// The usual case `-12.345678`: a whole number below 2^53 over a power of ten, both exact, so the one
/// rounding of the division gives the nearest f64. \[Clinger1990\]
fn parse_short(field: &[u8]) -> Option<Number> {
    let (negative, text) = match field {
        [b'-', rest @ ..] => (true, rest),
        _ => (false, field),
    };
    if text.len() > EXACT_DIGITS + 1 {
        return None;
    }
    let (mut mantissa, mut point) = (0_u64, None);
    for (i, &byte) in text.iter().enumerate() {
        match byte {
            b'0'..=b'9' => mantissa = 10 * mantissa + u64::from(byte - b'0'),
            b'.' if point.is_none() => point = Some(i),
            _ => return None,
        }
    }
    let whole = point.unwrap_or(text.len());
    let decimals = text.len() - point.map_or(whole, |p| p + 1);
    let bare_point = point.is_some() && decimals == 0;
    if whole == 0 || whole + decimals > EXACT_DIGITS || bare_point {
        return None;
    }
    let padded = whole > 1 && text.first() == Some(&b'0');
    let size = mantissa as f64 / POWERS[decimals];
    Some(Number {
        value: if negative { -size } else { size },
        decimals: u8::try_from(decimals).ok().filter(|_| !padded),
    })
}

fn parse_any(field: &[u8]) -> Option<Number> {
    let value: f64 = std::str::from_utf8(field).ok()?.parse().ok()?;
    let decimals = None;
    value.is_finite().then_some(Number { value, decimals })
}

/// Appends a finite number: with this many decimals where that loses nothing, else as short as exact.
pub(crate) fn write(out: &mut Vec<u8>, value: f64, decimals: Option<u8>) {
    // Writing to a Vec can't fail, so the results say nothing.
    let start = out.len();
    if let Some(decimals) = decimals.filter(|_| value.abs() < 1e9) {
        let _ = write!(out, "{value:.*}", usize::from(decimals));
        let same = |n: Number| n.value.to_bits() == value.to_bits();
        if parse(&out[start..]).is_some_and(same) {
            return;
        }
        out.truncate(start);
    }
    let _ = write!(out, "{value:?}");
}

#[cfg(test)]
mod tests {
    use super::*;

    fn decimals(text: &str) -> Option<u8> {
        parse(text.as_bytes()).unwrap().decimals
    }

    #[test]
    fn the_short_path_agrees_with_the_standard_library_to_the_bit() {
        for text in [
            "0",
            "-0",
            "-0.000000",
            "3.141593",
            "0.1",
            "123456789012345",
            "0.00000000000001",
            "-99999.9999999999",
            "007.5",
        ] {
            let number = parse_short(text.as_bytes()).unwrap();
            let std: f64 = text.parse().unwrap();
            assert_eq!(number.value.to_bits(), std.to_bits(), "{text}");
        }
    }

    #[test]
    fn other_spellings_are_read_but_promise_no_text() {
        for text in ["1e-3", "+0.5", ".5", "5.", "0.1234567890123456789", "00.5"] {
            let std: f64 = text.parse().unwrap();
            assert_eq!(
                parse(text.as_bytes()).unwrap().value.to_bits(),
                std.to_bits()
            );
            assert_eq!(decimals(text), None, "{text}");
        }
        assert_eq!(decimals("31"), Some(0));
        assert_eq!(decimals("-0.250"), Some(3));
    }

    #[test]
    fn what_is_not_a_finite_number_is_refused() {
        for text in [
            "",
            "-",
            ".",
            "nan",
            "NaN",
            "inf",
            "-Infinity",
            "1e999",
            "1,5",
            "0x1",
            "1 2",
        ] {
            assert_eq!(parse(text.as_bytes()), None, "{text}");
        }
    }

    #[test]
    fn decimals_are_kept_only_where_they_lose_nothing() {
        let text = |value, decimals| {
            let mut out = Vec::new();
            write(&mut out, value, decimals);
            String::from_utf8(out).unwrap()
        };
        assert_eq!(text(0.25, Some(6)), "0.250000");
        assert_eq!(text(-0.0, Some(2)), "-0.00");
        assert_eq!(text(1.0 / 3.0, Some(6)), "0.3333333333333333");
        assert_eq!(text(1e300, Some(6)), "1e300");
        assert_eq!(text(2.0, None), "2.0");
    }
}
