//! Which columns are coordinates: as said, by the names of a header, or the first ones where there is no doubt.

/// Columns by number from 0.
#[derive(Debug, PartialEq, Eq)]
pub(super) enum Columns {
    /// x, y and perhaps z.
    Numbers(Vec<usize>),
    /// A column of well-known text, such as `POINT (1 2)`.
    Geometry(usize),
}

/// What x, y and z are called together; pairs of one row belong together.
const FAMILIES: [[&[&str]; 3]; 3] = [
    [&["x"], &["y"], &["z"]],
    [&["easting", "east", "e", "rechtswert"], &["northing", "north", "n", "hochwert"], &[]],
    [&["lon", "lng", "long", "longitude"], &["lat", "latitude"], &[]],
];

/// What heights are called beside.
const HEIGHTS: [&str; 7] = ["z", "height", "elevation", "elev", "altitude", "alt", "h"];

/// What well-known text is called.
const GEOMETRIES: [&str; 5] = ["wkt", "geometry", "geom", "the_geom", "wkt_geom"];

/// Words that say nothing about the axis.
const FILLERS: [&str; 22] = [
    "coordinates",
    "coordinate",
    "coords",
    "coord",
    "values",
    "value",
    "val",
    "position",
    "pos",
    "point",
    "pnt",
    "pt",
    "utm",
    "map",
    "centroid",
    "center",
    "centre",
    "dd",
    "deg",
    "ft",
    "wgs84",
    "m",
];

impl Columns {
    /// Chooses by the fields of the first line; `header` tells whether they are names.
    pub(super) fn choose(fields: &[String], header: bool, said: &[String]) -> Result<Self, String> {
        if !said.is_empty() {
            return said
                .iter()
                .map(|name| column(fields, header, name))
                .collect::<Result<_, _>>()
                .map(Self::Numbers);
        }
        if let Some(numbers) = header.then(|| by_names(fields)).flatten() {
            return Ok(Self::Numbers(numbers));
        }
        let is_geometry = |field: &String| {
            let is_name = || GEOMETRIES.iter().any(|name| field.eq_ignore_ascii_case(name));
            if header { is_name() } else { super::wkt::is_geometry(field) }
        };
        if let Some(column) = fields.iter().position(is_geometry) {
            return Ok(Self::Geometry(column));
        }
        match fields.len() {
            0 | 1 => Err("a point needs two numbers, x and y".to_owned()),
            2 => Ok(Self::Numbers(vec![0, 1])),
            n if !header => Ok(Self::Numbers((0..n.min(3)).collect())),
            _ => Err(format!("none of the columns {} is called x or y", shortened(fields))),
        }
    }

    /// What to tell the user, if it is not plain.
    pub(super) fn remark(&self, fields: &[String], header: bool) -> Option<String> {
        let name = |&k: &usize| {
            if header { crate::error::excerpt(&fields[k]).to_owned() } else { (k + 1).to_string() }
        };
        match self {
            Self::Geometry(k) => Some(format!("column {} was taken as well-known text", name(k))),
            Self::Numbers(numbers) => {
                let plain = header && numbers.iter().zip(["x", "y", "z"]).all(|(&k, axis)| fields[k] == axis);
                if fields.len() == numbers.len() && (!header || plain) {
                    return None;
                }
                let names: Vec<String> = numbers.iter().map(name).collect();
                let axes = ["x", "y", "z"][..numbers.len().min(3)].join(", ");
                Some(format!("columns {} were taken as {axes}", names.join(", ")))
            }
        }
    }
}

/// Whether the first line is a header: nothing in it is a number, or it names x and y.
pub(super) fn is_header(fields: &[String], number: impl Fn(&str) -> bool) -> bool {
    if fields.iter().any(|field| super::wkt::is_geometry(field)) {
        return false;
    }
    fields.iter().all(|field| !number(field)) || by_names(fields).is_some()
}

/// The column that a name or a number from 1 stands for.
fn column(fields: &[String], header: bool, said: &str) -> Result<usize, String> {
    let said = said.trim();
    let named = fields.iter().position(|field| header && field.eq_ignore_ascii_case(said));
    let number = || said.parse::<usize>().ok().filter(|k| (1..=fields.len()).contains(k)).map(|k| k - 1);
    let among = || if header { shortened(fields) } else { format!("{} without names", fields.len()) };
    named.or_else(number).ok_or_else(|| format!("there is no column {said:?} among {}", among()))
}

fn by_names(fields: &[String]) -> Option<Vec<usize>> {
    let plain: Vec<String> = fields.iter().map(|field| plain(field)).collect();
    let find = |names: &[&str]| names.iter().find_map(|name| plain.iter().position(|field| field == name));
    let [x, y] = FAMILIES.iter().find_map(|[x, y, _]| Some([find(x)?, find(y)?]))?;
    let mut columns = vec![x, y];
    columns.extend(find(&HEIGHTS));
    Some(columns)
}

/// A name without units and words that say nothing: `X_COORD (m)` is `x`.
fn plain(name: &str) -> String {
    let name = name.split(['(', '[']).next().unwrap_or_default().to_ascii_lowercase();
    let words: Vec<&str> =
        name.split(|c: char| !c.is_ascii_alphanumeric()).filter(|word| !word.is_empty()).collect();
    let telling: Vec<&str> = words.iter().copied().filter(|word| !FILLERS.contains(word)).collect();
    let [word] = telling[..] else { return words.join(" ") };
    // Written together: xcoord, utmx.
    let rest =
        FILLERS.iter().find_map(|filler| word.strip_suffix(filler).or_else(|| word.strip_prefix(filler)));
    match rest {
        Some(axis @ ("x" | "y" | "z" | "e" | "n")) => axis.to_owned(),
        _ => word.to_owned(),
    }
}

/// Names for a message.
fn shortened(fields: &[String]) -> String {
    let names: Vec<&str> = fields.iter().take(8).map(|name| crate::error::excerpt(name)).collect();
    format!("{}{}", names.join(", "), if fields.len() > 8 { ", ..." } else { "" })
}

#[cfg(test)]
mod tests {
    use super::Columns;

    fn chosen(header: &str) -> Result<Columns, String> {
        let fields: Vec<String> = header.split(',').map(str::to_owned).collect();
        Columns::choose(&fields, true, &[])
    }

    #[test]
    fn names_that_people_use() {
        for (header, columns) in [
            ("x,y", vec![0, 1]),
            ("fid,X_COORD,Y_COORD,Z_VAL", vec![1, 2, 3]),
            ("id,Easting,Northing,Elevation", vec![1, 2, 3]),
            ("name,lat,lng", vec![2, 1]),
            ("latitude,longitude,alt", vec![1, 0, 2]),
            ("OBJECTID,POINT_X,POINT_Y,POINT_Z", vec![1, 2, 3]),
            ("xcoord,ycoord,id", vec![0, 1]),
            ("X (m),Y (m),Z (m)", vec![0, 1, 2]),
            ("lat,x,y,lon", vec![1, 2]),
            ("UTM_E,UTM_N", vec![0, 1]),
            ("first,second", vec![0, 1]),
        ] {
            assert_eq!(chosen(header), Ok(Columns::Numbers(columns)), "{header}");
        }
        assert_eq!(chosen("id,WKT"), Ok(Columns::Geometry(1)));
        assert_eq!(chosen("id,foo,bar"), Err("none of the columns id, foo, bar is called x or y".to_owned()));
    }
}
