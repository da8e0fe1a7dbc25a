//! Which columns are coordinates: as said, by the names of a header, or the first ones where there are no names. Names that
//! do not tell are refused, never guessed at.

use super::fields::Separator;
use super::missing::MISSING;
use crate::formats::wkt::is_geometry;

/// Columns by number from 0.
#[derive(Debug, PartialEq, Eq)]
pub(super) enum Columns {
    /// x, y and perhaps z.
    Numbers(Vec<usize>),
    /// A column of well-known text, such as `POINT (1 2)`.
    Geometry(usize),
}

/// Names of the columns x and y; names of one row belong together.
const FAMILIES: [[&[&str]; 2]; 10] = [
    [&["x"], &["y"]],
    [&["easting", "east", "e"], &["northing", "north", "n"]],
    [&["lon", "lng", "long", "longitude"], &["lat", "latitude"]],
    [&["ost", "ostwert", "rechtswert"], &["nord", "nordwert", "hochwert"]],
    [&["este", "longitud", "longitudine"], &["norte", "latitud", "latitudine"]],
    [&["laenge", "länge", "laengengrad", "längengrad"], &["breite", "breitengrad"]],
    [&["lengtegraad"], &["breedtegraad"]],
    [&["długość"], &["szerokość"]],
    [&["долгота"], &["широта"]],
    [&["经度", "経度"], &["纬度", "緯度"]],
];

/// Names of columns of heights.
const HEIGHTS: [&str; 14] = [
    "z",
    "height",
    "elevation",
    "elev",
    "ele",
    "altitude",
    "alt",
    "h",
    "höhe",
    "hoehe",
    "cota",
    "quota",
    "altitud",
    "altura",
];

/// Names of columns of well-known text.
const GEOMETRIES: [&str; 5] = ["wkt", "geometry", "geom", "the_geom", "wkt_geom"];

/// Words that say nothing about the axis.
const FILLERS: [&str; 24] = [
    "geogr",
    "geographische",
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
            let chosen = said.iter().map(|name| column(fields, header, name));
            return chosen.collect::<Result<_, _>>().map(Self::Numbers);
        }
        if header && let Some(numbers) = by_names(fields)? {
            return Ok(Self::Numbers(numbers));
        }
        let holds_geometry = |field: &String| {
            if header { names_geometry(field) } else { is_geometry(field) }
        };
        if let Some(column) = fields.iter().position(holds_geometry) {
            return Ok(Self::Geometry(column));
        }
        if header {
            return Err(format!("none of the columns {} is called x or y", shortened(fields)));
        }
        // A separator may follow the last field.
        let width = fields.iter().rposition(|field| !field.is_empty()).map_or(0, |last| last + 1);
        let is_number = |field: &str| super::number(field, Separator::Blank).is_some();
        let text = fields.iter().find(|field| !field.is_empty() && !is_number(field));
        match (width, text) {
            (0 | 1, _) => Err("a point needs two numbers, x and y".to_owned()),
            (4.., Some(text)) => Err(format!(
                "without names it cannot be told which of {width} columns are x and y, one of which is {:?}",
                crate::error::excerpt(text)
            )),
            _ => Ok(Self::Numbers((0..width.min(3)).collect())),
        }
    }

    /// A remark on the columns that were taken, unless it is plain.
    pub(super) fn remark(&self, fields: &[String], header: bool) -> Option<String> {
        let name = |&k: &usize| {
            if header { crate::error::excerpt(&fields[k]).to_owned() } else { (k + 1).to_string() }
        };
        match self {
            Self::Geometry(k) => Some(format!("column {} was taken as well-known text", name(k))),
            Self::Numbers(numbers) => {
                let plain = numbers.iter().zip(["x", "y", "z"]).all(|(&k, axis)| fields[k] == axis);
                if if header { plain } else { fields.len() == numbers.len() } {
                    return None;
                }
                let names: Vec<String> = numbers.iter().map(name).collect();
                let axes = ["x", "y", "z"][..numbers.len().min(3)].join(", ");
                Some(format!("columns {} were taken as {axes}", names.join(", ")))
            }
        }
    }
}

/// Whether the first line is a header: it names x and y, or has nothing but names.
pub(super) fn is_header(fields: &[String]) -> bool {
    let is_name = |field: &String| {
        let name = field.trim_start_matches(['#', '%', '/', ' ', '"']).to_lowercase();
        name.starts_with(|c: char| c.is_alphabetic() || c == '_') && !MISSING.contains(&name.as_str())
    };
    if fields.iter().any(|field| is_geometry(field)) {
        return false;
    }
    let is_fraction =
        |field: &String| field.contains('.') && super::number(field, Separator::Blank).is_some();
    if fields.iter().any(is_fraction) {
        return false;
    }
    let all = || fields.iter().all(|field| field.is_empty() || is_name(field)) && fields.iter().any(is_name);
    !matches!(by_names(fields), Ok(None)) || all()
}

/// Whether a name is that of a column of well-known text.
pub(super) fn names_geometry(name: &str) -> bool {
    GEOMETRIES.iter().any(|known| name.eq_ignore_ascii_case(known))
}

/// Whether one of the names that were said is among the fields of the first line, so that these are names.
pub(super) fn are_said(fields: &[String], said: &[String]) -> bool {
    let is_name = |name: &&String| name.trim().parse::<f64>().is_err();
    said.iter().filter(is_name).any(|name| fields.iter().any(|field| field.eq_ignore_ascii_case(name.trim())))
}

/// Whether names are as many as the fields of a line, and name x and y.
pub(super) fn name_points(names: &[String], width: usize) -> bool {
    names.len() == width && !matches!(by_names(names), Ok(None))
}

/// The column that a name or a number from 1 stands for.
fn column(fields: &[String], header: bool, said: &str) -> Result<usize, String> {
    let said = said.trim();
    let named = |is: &dyn Fn(&String) -> bool| -> Result<Option<usize>, String> {
        let mut columns = (0..fields.len()).filter(|&k| header && is(&fields[k]));
        match (columns.next(), columns.next()) {
            (Some(_), Some(_)) => Err(format!("two columns are called {said:?}: give the number of one")),
            (column, _) => Ok(column),
        }
    };
    // As it is written, or else in other letters.
    let exact = named(&|field| field == said)?;
    let named = if exact.is_some() { exact } else { named(&|field| field.eq_ignore_ascii_case(said))? };
    let number = || said.parse::<usize>().ok().filter(|k| (1..=fields.len()).contains(k)).map(|k| k - 1);
    let among = || if header { shortened(fields) } else { format!("{} without names", fields.len()) };
    named.or_else(number).ok_or_else(|| format!("there is no column {said:?} among {}", among()))
}

/// The columns that are called x and y, and perhaps z; an error if two are, or if angles are in parts.
fn by_names(fields: &[String]) -> Result<Option<Vec<usize>>, String> {
    let exact: Vec<String> = fields.iter().map(|field| field.to_lowercase()).collect();
    let plain: Vec<String> = fields.iter().map(|field| plain(field)).collect();
    let find = |names: &[&str]| {
        names.iter().find_map(|name| {
            let of = |list: &[String]| (0..list.len()).filter(|&k| list[k] == *name).collect::<Vec<_>>();
            [of(&exact), of(&plain)].into_iter().find(|columns| !columns.is_empty())
        })
    };
    let Some([x, y]) = FAMILIES.iter().find_map(|[x, y]| Some([find(x)?, find(y)?])) else { return Ok(None) };
    let minutes = |field: &String| {
        let words = words(field);
        let any = |list: &[&str]| words.iter().any(|word| list.contains(&word.as_str()));
        any(&["lat", "latitude", "lon", "lng", "long", "longitude"])
            && any(&["min", "minute", "minutes", "sec", "second", "seconds"])
    };
    if fields.iter().any(minutes) {
        return Err("degrees, minutes and seconds in columns of their own are not put together".to_owned());
    }
    let mut columns = Vec::new();
    for found in [Some(x), Some(y), find(&HEIGHTS)].into_iter().flatten() {
        match found[..] {
            [column] => columns.push(column),
            _ => {
                return Err(format!("two columns are called {:?}", crate::error::excerpt(&fields[found[0]])));
            }
        }
    }
    Ok(Some(columns))
}

/// The words of a name, without units in brackets.
fn words(name: &str) -> Vec<String> {
    let name = name.split(['(', '[']).next().unwrap_or_default().to_lowercase();
    name.split(|c: char| !c.is_alphanumeric()).filter(|word| !word.is_empty()).map(str::to_owned).collect()
}

/// A name without units and words that say nothing: `X_COORD (m)` is `x`.
fn plain(name: &str) -> String {
    let words = words(name);
    let telling: Vec<&String> = words.iter().filter(|word| !FILLERS.contains(&word.as_str())).collect();
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
            ("Breitengrad,Längengrad", vec![1, 0]),
            ("id,Geogr. Breite,Geogr. Länge", vec![2, 1]),
            ("breedtegraad,lengtegraad", vec![1, 0]),
            ("szerokość,długość,wysokość", vec![1, 0]),
            ("Широта,Долгота", vec![1, 0]),
            ("名称,经度,纬度", vec![1, 2]),
            ("xcoord,ycoord,id", vec![0, 1]),
            ("X (m),Y (m),Z (m)", vec![0, 1, 2]),
            ("lat,x,y,lon", vec![1, 2]),
            ("UTM_E,UTM_N", vec![0, 1]),
            ("Point,Northing,Easting,Elevation,Description", vec![2, 1, 3]),
            ("FID,Shape,POINT_X,POINT_Y", vec![2, 3]),
            ("Point_ID,x,y", vec![1, 2]),
            ("Breite;Laenge".replace(';', ",").as_str(), vec![1, 0]),
            ("x,y,POINT_X", vec![0, 1]),
            ("x,y,latency_sec", vec![0, 1]),
        ] {
            assert_eq!(chosen(header), Ok(Columns::Numbers(columns)), "{header}");
        }
        assert_eq!(chosen("id,WKT"), Ok(Columns::Geometry(1)));
        assert_eq!(chosen("id,foo,bar"), Err("none of the columns id, foo, bar is called x or y".to_owned()));
        for header in ["first,second", "time,z", "y1,x1", "x,y,x", "lat_deg,lat_min,lon_deg,lon_min"] {
            assert!(chosen(header).is_err(), "{header}");
        }
        let said = |header: &str, names: [&str; 2]| {
            let fields: Vec<String> = header.split(',').map(str::to_owned).collect();
            Columns::choose(&fields, true, &names.map(str::to_owned))
        };
        assert_eq!(said("a,A,b", ["A", "b"]), Ok(Columns::Numbers(vec![1, 2])));
        assert!(said("a,a,b", ["a", "b"]).is_err());
        assert_eq!(said("a,a,b", ["2", "B"]), Ok(Columns::Numbers(vec![1, 2])));
    }
}
