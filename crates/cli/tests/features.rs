//! An optional feature of the program: tables in Parquet. `folder.rs` has more of it.

use std::fs;

use crate::place::Place;

#[test]
fn tables_are_written() {
    let place = Place::new();
    place.succeed("-q generate uniform -n 2000 --seed 3 -o p.csv");
    place.succeed("-q tiles p.csv -o t --tile 300 --parquet");
    let names = fs::read_dir(place.path("t")).expect("readable").map(|e| e.expect("readable").file_name());
    let names: Vec<String> = names.map(|name| name.to_string_lossy().into_owned()).collect();
    for name in &names {
        if let Some(number) = name.strip_suffix(".npy").filter(|name| !name.starts_with("ids")) {
            let table = format!("{number}.parquet").replace("seam", "triangles");
            let bytes = fs::read(place.path("t").join(&table)).expect("a table for each shard");
            assert!(bytes.starts_with(b"PAR1") && bytes.ends_with(b"PAR1"), "{table}");
        }
    }
}
