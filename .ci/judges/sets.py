"""Everyday sets of points: what people measure, draw and scan, at the size that a judge reads in a moment."""

import numpy as np

UTM = np.array([500_000.0, 4_500_000.0])
ECEF = np.array([4_027_893.75, 307_045.6])


def grid(columns, rows):
    """Rows of whole numbers from zero, row by row."""
    y, x = np.mgrid[0:rows, 0:columns]
    return np.column_stack([x.ravel(), y.ravel()]).astype(float)


def turned(points, degrees):
    """Turned around the origin."""
    angle = np.radians(degrees)
    cos, sin = np.cos(angle), np.sin(angle)
    return points @ np.array([[cos, sin], [-sin, cos]])


def ring(count, radius=1.0, about=(0.0, 0.0)):
    """Points of a circle."""
    angle = 2 * np.pi * np.arange(count) / count
    return np.column_stack([radius * np.cos(angle), radius * np.sin(angle)]) + about


def pipes(count, sides, radius):
    """Regular polygons around the points of a lattice."""
    return np.vstack([ring(sides, radius, about) for about in 3 * radius * grid(count, count)])


def planar():
    """Sets of the plane by name."""
    random = np.random.default_rng(7)
    uniform = random.random((300, 2))
    hexagons = grid(18, 18)
    hexagons[:, 0] += 0.5 * (hexagons[:, 1] % 2)
    hexagons[:, 1] *= np.sqrt(3) / 2
    levels = np.vstack([ring(60, r / 10, (0.37, 0.21)) for r in range(1, 7)])
    survey_grid = turned(5 * grid(15, 15), 12.0) + UTM
    return {
        "uniform": uniform,
        "lattice of tenths": 0.1 * grid(20, 20),
        "lattice of three tenths": 0.3 * grid(17, 17),
        "lattice of thirds": grid(17, 17) / 3,
        "linspace": grid(18, 18) / 17,
        "tenths at UTM": 0.1 * grid(17, 17) + UTM,
        "half metres at ECEF": 0.3 * grid(15, 15) + ECEF,
        "lattice turned by 17": turned(0.1 * grid(17, 17), 17.0),
        "lattice turned by 45": turned(grid(17, 17), 45.0),
        "lattice of 1e-6 at UTM": 1e-6 * grid(12, 12) + UTM,
        "hexagons": hexagons,
        "hexagons of tenths": 0.1 * hexagons,
        "circle of 100": ring(100),
        "circle beside the origin": ring(90, 2.5, (100.3, 250.7)),
        "circles around one center": levels,
        "pipes of 25 sides": pipes(4, 25, 0.25),
        "pipes of 12 sides at UTM": pipes(4, 12, 0.25) + UTM,
        "survey to two decimals": np.round(100 * uniform, 2) + np.round(UTM, 2),
        "survey to three decimals": np.round(50 * random.random((300, 2)), 3) + UTM,
        "survey grid to three decimals": np.round(survey_grid, 3),
        "rounded to a tenth": np.round(10 * random.random((400, 2)), 1),
        "scan to a hundredth": np.round(20 * random.random((400, 2)), 2) + UTM,
        "pixels": np.floor(40 * random.random((300, 2))),
        "degrees": np.round(np.array([7.4, 46.9]) + 0.02 * random.random((300, 2)), 6),
        "single precision": uniform.astype(np.float32).astype(float),
        "clusters": np.vstack([c + 1e-4 * random.standard_normal((30, 2)) for c in random.random((9, 2))]),
        "duplicates": np.repeat(random.random((80, 2)), 3, axis=0),
        "tiny": 1e-120 * grid(12, 12) / 7,
        "huge": 1e120 * grid(12, 12) / 7,
        "on a line": np.column_stack([np.arange(20) / 10, np.arange(20) * 0.3]),
        "three points": np.array([[0.0, 0.0], [0.7, 0.1], [0.3, 0.9]]),
        "two points": np.array([[0.1, 0.2], [0.7, 0.3]]),
    }


def relief():
    """Sets of the plane with heights by name: surveys, elevation models of whole metres, ridges and plains at a level."""
    random = np.random.default_rng(9)

    def hills(p):
        x, y = (p - p.min(axis=0)).T / np.ptp(p, axis=0).max()
        return 40 * np.sin(5 * x) * np.cos(4 * y) + 25 * x + 50

    sets = {}
    for name, points in planar().items():
        size = np.ptp(points, axis=0)
        if len(points) > 20 and (size > 0).all() and 1e-9 < size.max() < 1e9 and np.linalg.matrix_rank(points - points[0]) == 2:
            points = np.unique(points, axis=0)
            sets[name] = np.column_stack([points, hills(points)])
            sets[f"{name}, whole metres"] = np.column_stack([points, np.round(hills(points) / 5)])
    lattice = 30.0 * grid(24, 24)
    sets["elevation model of whole metres"] = np.column_stack([lattice, np.round(hills(lattice) + random.random(len(lattice)))])
    sets["terraces"] = np.column_stack([lattice, 10 * np.floor(hills(lattice) / 10)])
    return sets


def solids():
    """Sets of space by name: lattices, scans of surfaces, molecules, clusters."""
    random = np.random.default_rng(5)
    z, y, x = np.mgrid[0:6, 0:6, 0:6]
    lattice = np.column_stack([x.ravel(), y.ravel(), z.ravel()]).astype(float)
    ball = random.standard_normal((400, 3))
    sphere = ball / np.linalg.norm(ball, axis=1)[:, None]
    angle = 2 * np.pi * random.random((500, 2))
    torus = np.column_stack(
        [(3 + np.cos(angle[:, 1])) * np.cos(angle[:, 0]), (3 + np.cos(angle[:, 1])) * np.sin(angle[:, 0]), np.sin(angle[:, 1])]
    )
    return {
        "uniform": random.random((300, 3)),
        "half of a lattice": lattice[random.random(len(lattice)) < 0.6],
        "lattice of tenths": 0.1 * lattice,
        "sphere": sphere,
        "ball to three decimals": np.round(ball, 3),
        "torus": torus,
        "torus at UTM": torus + np.array([*UTM, 300.0]),
        "clusters": np.vstack([c + 0.05 * random.standard_normal((40, 3)) for c in random.random((6, 3))]),
        "pixels": np.floor(7 * random.random((200, 3))),
        "helix": np.column_stack([np.cos(sphere[:, 0] * 9), np.sin(sphere[:, 0] * 9), sphere[:, 0]]) + 0.05 * ball,
    }


def polygons():
    """Polygons by name: plots, coasts rounded to few decimals, gears, combs, holes near the border."""
    import shapely

    random = np.random.default_rng(13)
    angle = 2 * np.pi * np.arange(240) / 240
    coast = 1 + 0.25 * np.sin(5 * angle) + 0.1 * np.cumsum(random.standard_normal(240)) / 15
    coast = np.column_stack([coast * np.cos(angle), coast * np.sin(angle)])
    rounded = shapely.make_valid(shapely.Polygon(np.round(coast, 2)))
    rounded = max(shapely.get_parts(rounded), key=lambda part: part.area)
    gear = np.column_stack([np.cos(angle), np.sin(angle)]) * np.where(np.arange(240) % 8 < 4, 1.0, 0.9)[:, None]
    comb = [(i, j) for i in range(9) for j in ([0, 5] if i % 2 else [5, 0])]
    block = shapely.box(0, 0, 30, 20)
    yards = [shapely.box(x, y, x + 4, y + 3).exterior for x in (2, 9.05, 20) for y in (2, 8, 14)]
    moved = shapely.affinity.translate(shapely.affinity.rotate(block, 17), *UTM)
    return {
        "square": shapely.box(0, 0, 1, 1),
        "square of ten kilometres": shapely.box(0, 0, 10_000, 10_000),
        "coast": shapely.Polygon(coast),
        "coast to two decimals": rounded,
        "gear": shapely.Polygon(gear),
        "comb": shapely.Polygon([*comb, (8.5, -1), (-0.5, -1)]),
        "block with yards": shapely.Polygon(block.exterior, yards),
        "plot at UTM": moved,
        "plot at UTM to three decimals": shapely.set_precision(moved, 0.001),
        "circle": shapely.Point(0.3, 0.1).buffer(1, 40),
        "narrow strip": shapely.Polygon([(0, 0), (100, 0), (100, 0.5), (0, 0.6)]),
        "hole near the border": shapely.Polygon(block.exterior, [shapely.box(1e-3, 5, 6, 9).exterior]),
    }
