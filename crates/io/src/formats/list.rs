//! Numbers as text: one in each line. A first line that is none is passed over, and so are remarks after `#`.

use super::lines::Lines;
use crate::error::excerpt;
use crate::{Error, Source};

/// Reads all numbers.
pub(crate) fn read(source: Box<dyn Source>) -> Result<Vec<f64>, Error> {
    let mut lines = Lines::new(source);
    let mut numbers = Vec::new();
    let mut is_first = true;
    while let Some(line) = lines.next()? {
        let word = line.text.trim().trim_end_matches([',', ';']);
        let is_first = std::mem::take(&mut is_first);
        match word.parse() {
            Ok(number) => numbers.push(number),
            // A heading has no number in it; several numbers are one too many.
            Err(_) if is_first && !holds_number(word) => {}
            Err(_) => {
                return Err(line.error(format!("{:?} where one number is wanted", excerpt(word))));
            }
        }
    }
    Ok(numbers)
}

fn holds_number(line: &str) -> bool {
    line.split([',', ';', ' ', '\t']).any(|word| word.trim().parse::<f64>().is_ok())
}

#[cfg(test)]
mod tests {
    use std::io::Cursor;

    use super::read;

    #[test]
    fn a_number_a_line() {
        let of = |text: &'static str| read(Box::new(Cursor::new(text)));
        assert_eq!(of("weight\n1\n-2.5e3\n").expect("numbers"), [1.0, -2500.0]);
        assert_eq!(of("0.5\n# none\n\n7\n").expect("numbers"), [0.5, 7.0]);
        assert_eq!(of("").expect("nothing"), Vec::<f64>::new());
        let error = of("1\n2,3\n").expect_err("two numbers").to_string();
        assert!(error.contains("line 2") && error.contains("2,3"), "{error}");
        assert!(of("1\nx\n").is_err());
        assert!(of("0.5,0.25\n1\n").expect_err("two numbers").to_string().contains("line 1"));
    }
}
