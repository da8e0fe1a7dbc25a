"""Makes the files of this folder, or larger ones: the same points as one LAZ file, as COPC and as EPT of three kinds.

    python3 make.py [FOLDER [POINTS]]

Needs numpy, laspy, lazrs and the program zstd.
"""

import json
import struct
import subprocess
import sys
from pathlib import Path

import laspy
import lazrs
import numpy as np

FOLDER = Path(sys.argv[1]) if len(sys.argv) > 1 else Path(__file__).parent
COUNT = int(sys.argv[2]) if len(sys.argv) > 2 else 600
NODE = max(COUNT // 20, 40)
LOW, WIDTH = np.array([1000.0, 2000.0, -50.0]), 128.0
WKT = (
    'PROJCS["ETRS89 / UTM zone 32N",GEOGCS["ETRS89",DATUM["European_Terrestrial_Reference_System_1989",'
    'SPHEROID["GRS 1980",6378137,298.257222101]],PRIMEM["Greenwich",0],UNIT["degree",0.0174532925199433]],'
    'PROJECTION["Transverse_Mercator"],UNIT["metre",1],AUTHORITY["EPSG","25832"]]'
)


def header():
    made = laspy.LasHeader(point_format=7, version="1.4")
    made.scales, made.offsets = np.array([0.01] * 3), np.array([1000.0, 2000.0, 0.0])
    made.creation_date = None
    made.add_extra_dims(
        [
            laspy.ExtraBytesParams("Reflectance", "i2", scales=[0.01], offsets=[-5.0], no_data=[-32768]),
            laspy.ExtraBytesParams("Normal", "3f4"),
            laspy.ExtraBytesParams("Pulse", "u8"),
        ]
    )
    made.vlrs.append(laspy.vlrs.known.WktCoordinateSystemVlr(WKT))
    made.global_encoding.wkt = True
    return made


def cloud():
    random = np.random.default_rng(7)
    made = laspy.LasData(header())
    x, y = random.random(COUNT) ** 1.5 * 127, random.random(COUNT) * 127
    made.x, made.y, made.z = LOW[0] + x, LOW[1] + y, 20 + 10 * np.sin(x / 20) + 5 * random.random(COUNT)
    made.intensity = random.integers(0, 65536, COUNT)
    made.classification = random.choice([1, 2, 2, 5], COUNT)
    made.number_of_returns = random.integers(1, 4, COUNT)
    made.return_number = np.minimum(random.integers(1, 4, COUNT), made.number_of_returns)
    made.withheld = random.random(COUNT) < 0.05
    made.overlap = random.random(COUNT) < 0.1
    made.scan_angle = random.integers(-5000, 5000, COUNT)
    made.user_data = random.integers(0, 256, COUNT)
    made.point_source_id = random.integers(0, 65536, COUNT)
    made.gps_time = 1e9 + np.arange(COUNT) / 1024
    made.red, made.green, made.blue = random.integers(0, 65536, (3, COUNT))
    stored = random.integers(-3000, 3000, COUNT).astype("i2")
    stored[::50] = -32768
    made.points.array["Reflectance"] = stored
    made["Normal"] = random.normal(size=(COUNT, 3)).astype("f4")
    made["Pulse"] = random.integers(0, 2**64, COUNT, dtype="u8")
    return made


def nodes(made):
    """The nodes of an octree: each keeps some of its points, and gives the rest to its children."""
    place = np.stack([made.x, made.y, made.z], axis=1)
    found = {}
    pending = [((0, 0, 0, 0), np.arange(COUNT))]
    while pending:
        key, points = pending.pop()
        found[key] = points[:NODE]
        rest = points[NODE:]
        if len(rest):
            depth = key[0] + 1
            cell = np.floor((place[rest] - LOW) / (WIDTH / 2**depth)).astype(int)
            for child in np.unique(cell, axis=0):
                pending.append(((depth, *map(int, child)), rest[(cell == child).all(axis=1)]))
    return dict(sorted(found.items()))


def is_below(key, top):
    shift = key[0] - top[0]
    return shift >= 0 and all(key[i] >> shift == top[i] for i in (1, 2, 3))


def second_page(found):
    """The node of depth 1 with most nodes below it."""
    return max((k for k in found if k[0] == 1), key=lambda top: sum(is_below(k, top) for k in found))


def write_copc(made, found, path):
    plain = path.with_suffix(".plain.las")
    made.write(plain)
    data = bytearray(plain.read_bytes())
    plain.unlink()
    start, count = struct.unpack_from("<II", data, 96)
    length = struct.unpack_from("<H", data, 105)[0]
    records = np.frombuffer(bytes(data[start : start + COUNT * length]), np.uint8).reshape(COUNT, length)
    kind = lazrs.LazVlr.new_for_compression(7, made.point_format.num_extra_bytes, True)

    def vlr(owner, number, content):
        return struct.pack("<H16sHH32s", 0, owner, number, len(content), b"") + content

    old = bytes(data[375:start])
    compression = vlr(b"laszip encoded", 22204, bytes(kind.record_data()))
    begin = 375 + 54 + 160 + len(compression) + len(old)
    with open(path, "wb") as out:
        out.write(bytes(begin))
        packer = lazrs.LasZipCompressor(out, kind)
        packer.reserve_offset_to_chunk_table()
        places = {}
        for key, points in found.items():
            here = out.tell()
            packer.compress_many(np.ascontiguousarray(records[points]).reshape(-1))
            packer.finish_current_chunk()
            places[key] = (here, out.tell() - here, len(points))
        packer.done()
        end = out.tell()

    def page(keys, more):
        entries = [struct.pack("<4iQii", *k, *places[k]) for k in keys]
        return b"".join(entries + [struct.pack("<4iQii", *k, at, size, -1) for k, at, size in more])

    top = second_page(found)
    second = page([k for k in found if is_below(k, top)], [])
    first = page([k for k in found if not is_below(k, top)], [(top, end + 60, len(second))])
    pages = second + first
    info = struct.pack("<5d2Q2d", *(LOW + WIDTH / 2), WIDTH / 2, 4.0, end + 60 + len(second), len(first), 1e9, 2e9)
    head = data[:375]
    struct.pack_into("<II", head, 96, begin, count + 2)
    head[104] |= 0x80
    struct.pack_into("<QI", head, 235, end, 1)
    with open(path, "r+b") as out:
        out.write(bytes(head) + vlr(b"copc", 1, info + bytes(160 - len(info))) + compression + old)
        out.seek(end)
        out.write(struct.pack("<H16sHQ32s", 0, b"copc", 1000, len(pages), b"") + pages)


def write_ept(made, found, folder, kind):
    dims = [("X", "i4"), ("Y", "i4"), ("Z", "i4"), ("Intensity", "u2"), ("ReturnNumber", "u1"), ("NumberOfReturns", "u1")]
    dims += [("Classification", "u1"), ("Withheld", "u1"), ("Overlap", "u1"), ("GpsTime", "f8"), ("Red", "u2")]
    dims += [("Reflectance", "f8"), ("Pulse", "u8")]
    laz = {"GpsTime": "gps_time", "ReturnNumber": "return_number", "NumberOfReturns": "number_of_returns"}
    names = {"i": "signed", "u": "unsigned", "f": "float"}
    schema = [{"name": n, "type": names[t[0]], "size": int(t[1])} for n, t in dims]
    for field, scale, offset in zip(schema, made.header.scales, made.header.offsets):
        field.update(scale=float(scale), offset=float(offset))
    records = np.zeros(COUNT, [(n, "<" + t) for n, t in dims])
    for name, _ in dims:
        own = laz.get(name, name if name in "XYZ" or name in ("Reflectance", "Pulse") else name.lower())
        records[name] = made[own]
    (folder / "ept-data").mkdir(parents=True, exist_ok=True)
    (folder / "ept-hierarchy").mkdir(exist_ok=True)
    for key, points in found.items():
        path = folder / "ept-data" / "{}-{}-{}-{}".format(*key)
        if kind == "laszip":
            laspy.LasData(made.header, made.points[points]).write(path.with_suffix(".laz"))
        else:
            path.with_suffix(".bin").write_bytes(records[points].tobytes())
            if kind == "zstandard":
                subprocess.run(["zstd", "-q", "--rm", "-f", path.with_suffix(".bin"), "-o", path.with_suffix(".zst")], check=True)
    top = second_page(found)
    name = "{}-{}-{}-{}".format
    first = {name(*k): len(p) for k, p in found.items() if not is_below(k, top)} | {name(*top): -1}
    second = {name(*k): len(p) for k, p in found.items() if is_below(k, top)}
    (folder / "ept-hierarchy" / "0-0-0-0.json").write_text(json.dumps(first, indent=1))
    (folder / "ept-hierarchy" / (name(*top) + ".json")).write_text(json.dumps(second, indent=1))
    about = {
        "bounds": [*LOW, *(LOW + WIDTH)],
        "dataType": kind,
        "hierarchyType": "json",
        "points": COUNT,
        "schema": schema,
        "span": 128,
        "srs": {"authority": "EPSG", "horizontal": "25832", "wkt": WKT},
        "version": "1.1.0",
    }
    (folder / "ept.json").write_text(json.dumps(about, indent=1))


if __name__ == "__main__":
    points = cloud()
    FOLDER.mkdir(exist_ok=True)
    points.write(FOLDER / "small.laz")
    tree = nodes(points)
    write_copc(points, tree, FOLDER / "small.copc.laz")
    for kind in ("laszip", "binary", "zstandard"):
        write_ept(points, tree, FOLDER / kind, kind)
    print(len(tree), "nodes")
