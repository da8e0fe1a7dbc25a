//! Point clouds of the Point Cloud Library (`PCD` 0.7): as text, binary, and compressed by LZF.

use std::io::Read;

use super::numbers::Number;
use crate::error::excerpt;
use crate::{Cloud, Error, Source};

/// A field of a point: its name, its type, how many numbers it has.
struct Field {
    name: String,
    kind: Number,
    count: usize,
}

fn broken(what: impl std::fmt::Display) -> Error {
    Error::content(format!("PCD: {what}"))
}

/// Reads the points; those without coordinates, which stand for measurements that failed, are left out.
pub(crate) fn read(mut source: Box<dyn Source>) -> Result<Cloud, Error> {
    let mut bytes = Vec::new();
    source.read_to_end(&mut bytes)?;
    let header = Header::parse(&bytes)?;
    let data = &bytes[header.length..];
    let column = |name: &str| {
        let place = header.fields.iter().position(|field| field.name == name);
        place.ok_or_else(|| broken(format!("the points have no field {name}")))
    };
    let (x, y, z) = (column("x")?, column("y")?, column("z").ok());
    let mut cloud = Cloud::with_capacity(0, z.is_some());
    let mut failed = 0_usize;
    let mut push = |[x, y, z]: [f64; 3]| {
        if x.is_nan() || y.is_nan() || z.is_nan() { failed += 1 } else { cloud.push([x, y], z) }
    };
    let early = |i: usize| Error::Truncated(format!("after {i} of {} points", header.points));
    match header.data.as_str() {
        "ascii" => {
            let before = |field: usize| header.fields[..field].iter().map(|field| field.count).sum::<usize>();
            let text = String::from_utf8_lossy(data);
            let mut lines = text.lines().filter(|line| !line.trim().is_empty());
            for i in 0..header.points {
                let words: Vec<&str> = lines.next().ok_or_else(|| early(i))?.split_whitespace().collect();
                let number = |field: usize| {
                    let word = words.get(before(field)).copied().unwrap_or_default();
                    let wrong = || broken(format!("point {i} has {:?} for a number", excerpt(word)));
                    word.parse::<f64>().map_err(|_| wrong())
                };
                push([number(x)?, number(y)?, z.map_or(Ok(0.0), number)?]);
            }
        }
        "binary" => {
            let size: usize = header.fields.iter().map(Field::size).sum();
            let before = |field: usize| header.fields[..field].iter().map(Field::size).sum::<usize>();
            if data.len() / size < header.points {
                return Err(early(data.len() / size));
            }
            for point in data.chunks_exact(size).take(header.points) {
                let number = |field: usize| header.fields[field].kind.read(&point[before(field)..], false);
                push([number(x), number(y), z.map_or(0.0, number)]);
            }
        }
        "binary_compressed" => {
            // Field after field.
            let data = decompressed(data)?;
            let start = |field: usize| {
                header.fields[..field].iter().map(|field| field.size() * header.points).sum::<usize>()
            };
            let size: usize = header.fields.iter().map(Field::size).sum();
            if data.len() / size < header.points {
                return Err(early(data.len() / size));
            }
            for i in 0..header.points {
                let number = |field: usize| {
                    let about = &header.fields[field];
                    about.kind.read(&data[start(field) + i * about.size()..], false)
                };
                push([number(x), number(y), z.map_or(0.0, number)]);
            }
        }
        other => return Err(broken(format!("data of kind {:?} are not read", excerpt(other)))),
    }
    cloud.lose_values(header.fields.iter().map(|field| field.name.as_str()));
    if failed > 0 {
        cloud.remarks.push(format!("{failed} points without coordinates were left out"));
    }
    Ok(cloud)
}

impl Field {
    fn size(&self) -> usize {
        self.kind.size() * self.count
    }
}

struct Header {
    fields: Vec<Field>,
    points: usize,
    data: String,
    /// Bytes before the data.
    length: usize,
}

impl Header {
    fn parse(bytes: &[u8]) -> Result<Self, Error> {
        let (mut names, mut sizes, mut kinds, mut counts) = (vec![], vec![], vec![], vec![]);
        let (mut width, mut height, mut points) = (None, 1, None);
        let mut length = 0;
        for line in bytes.split_inclusive(|&byte| byte == b'\n') {
            length += line.len();
            let line = String::from_utf8_lossy(line);
            let mut words = line.split_whitespace();
            let number = |word: Option<&str>| {
                let word = word.unwrap_or_default();
                word.parse::<usize>()
                    .map_err(|_| broken(format!("the header has {:?} for a number", excerpt(word))))
            };
            match words.next() {
                Some("FIELDS") => names = words.map(str::to_owned).collect(),
                Some("SIZE") => sizes = words.map(|word| number(Some(word))).collect::<Result<_, _>>()?,
                Some("TYPE") => kinds = words.map(str::to_owned).collect(),
                Some("COUNT") => counts = words.map(|word| number(Some(word))).collect::<Result<_, _>>()?,
                Some("WIDTH") => width = Some(number(words.next())?),
                Some("HEIGHT") => height = number(words.next())?,
                Some("POINTS") => points = Some(number(words.next())?),
                Some("DATA") => {
                    let points = points.or_else(|| width?.checked_mul(height));
                    let points =
                        points.ok_or_else(|| broken("the header does not tell the number of points"))?;
                    let fields = fields(names, &sizes, &kinds, &counts)?;
                    let data = words.next().unwrap_or_default().to_owned();
                    return Ok(Self { fields, points, data, length });
                }
                Some("VERSION" | "VIEWPOINT") | None => {}
                Some(word) if word.starts_with('#') => {}
                Some(other) => return Err(broken(format!("{:?} is no line of a header", excerpt(other)))),
            }
        }
        Err(Error::Truncated("inside the header".to_owned()))
    }
}

fn fields(
    names: Vec<String>,
    sizes: &[usize],
    kinds: &[String],
    counts: &[usize],
) -> Result<Vec<Field>, Error> {
    let field = |(i, name): (usize, String)| {
        let size = *sizes.get(i)?;
        let kind = match kinds.get(i)?.as_str() {
            "F" => Number::Float(size),
            "I" => Number::Signed(size),
            "U" => Number::Unsigned(size),
            _ => return None,
        };
        let count = counts.get(i).copied().unwrap_or(1);
        (1..=1 << 16).contains(&count).then_some(())?;
        Some(Field { name, kind: kind.checked()?, count })
    };
    let fields: Option<Vec<Field>> = names.into_iter().enumerate().map(field).collect();
    fields
        .filter(|fields| !fields.is_empty())
        .ok_or_else(|| broken("the header does not describe its fields"))
}

/// Decompresses LZF: two lengths, then literal runs and references back (Lehmann's liblzf).
fn decompressed(data: &[u8]) -> Result<Vec<u8>, Error> {
    let wrong = || broken("the compressed data are damaged");
    let length = |at: usize| {
        let word = data.get(at..at + 4)?;
        Some(u32::from_le_bytes([word[0], word[1], word[2], word[3]]) as usize)
    };
    let (packed, unpacked) = (length(0).ok_or_else(wrong)?, length(4).ok_or_else(wrong)?);
    let mut bytes = data.get(8..8 + packed).ok_or_else(wrong)?.iter().copied();
    let mut out: Vec<u8> = Vec::new();
    while let Some(control) = bytes.next() {
        let control = usize::from(control);
        if control < 32 {
            let run: Vec<u8> = bytes.by_ref().take(control + 1).collect();
            if run.len() <= control {
                return Err(wrong());
            }
            out.extend(run);
        } else {
            let mut count = control >> 5;
            if count == 7 {
                count += usize::from(bytes.next().ok_or_else(wrong)?);
            }
            let back = ((control & 31) << 8) + usize::from(bytes.next().ok_or_else(wrong)?) + 1;
            let from = out.len().checked_sub(back).ok_or_else(wrong)?;
            (0..count + 2).for_each(|k| out.push(out[from + k]));
        }
        if out.len() > unpacked {
            return Err(wrong());
        }
    }
    if out.len() == unpacked { Ok(out) } else { Err(wrong()) }
}

#[cfg(test)]
mod tests {
    use super::read;
    use std::io::Cursor;

    fn file(data: &str, content: &[u8]) -> Vec<u8> {
        let header = "# .PCD v0.7\nVERSION 0.7\nFIELDS x y z rgb\nSIZE 4 4 4 4\nTYPE F F F U\nCOUNT 1 1 1 1\nWIDTH 2\n\
            HEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS 2\n";
        [format!("{header}DATA {data}\n").as_bytes(), content].concat()
    }

    #[test]
    fn all_kinds_of_data() {
        let numbers = [1.0_f32, 2.0, 3.0, 0.0, 4.0, 5.0, 6.0, 0.0];
        let binary: Vec<u8> = numbers.iter().flat_map(|x| x.to_le_bytes()).collect();
        let columns: Vec<u8> =
            [0, 4, 1, 5, 2, 6, 3, 7].iter().flat_map(|&k| numbers[k as usize].to_le_bytes()).collect();
        // 32 bytes as one run, and the last eight zeros as a reference: a run of 25, then 7 bytes from one back.
        let mut packed = vec![24];
        packed.extend(&columns[..25]);
        packed.extend([5 << 5, 0]);
        let compressed = [&(packed.len() as u32).to_le_bytes()[..], &32_u32.to_le_bytes(), &packed].concat();
        for (kind, content) in
            [("ascii", b"1 2 3 0\n4 5 6 0\n".to_vec()), ("binary", binary), ("binary_compressed", compressed)]
        {
            let cloud = read(Box::new(Cursor::new(file(kind, &content)))).expect(kind);
            assert_eq!((cloud.xy, cloud.z), (vec![[1.0, 2.0], [4.0, 5.0]], Some(vec![3.0, 6.0])), "{kind}");
        }
        let failed = read(Box::new(Cursor::new(file("ascii", b"1 2 3 0\nnan nan nan 0\n")))).expect("valid");
        assert_eq!((failed.xy.len(), failed.remarks.len()), (1, 1));
        for content in [&b"1 2 3 0\n"[..], b""] {
            let error = read(Box::new(Cursor::new(file("ascii", content)))).expect_err("short");
            assert!(error.to_string().contains("of 2 points"), "{error}");
        }
    }
}
