// Formats by what people call them.

const titles = {
  geojson: "GeoJSON", fgb: "FlatGeobuf", wkt: "WKT", wkb: "WKB", csv: "CSV", npy: "NumPy .npy", ply: "PLY", obj: "OBJ", off: "OFF", stl: "STL", vtu: "VTK .vtu",
  xdmf: "XDMF", msh: "Gmsh .msh", inp: "Abaqus .inp", mesh: "Medit .mesh", su2: "SU2", "2dm": "SMS .2dm", 14: "ADCIRC .14", bdf: "Nastran .bdf", node: "Triangle .node",
  ele: "Triangle .ele", poly: "Triangle .poly", edge: "Triangle .edge", neigh: "Triangle .neigh", svg: "SVG picture", png: "PNG picture",
};

/** The name of a format; its extension where there is no other. */
export const titleOf = (format) => titles[format] ?? format;
