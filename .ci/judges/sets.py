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
        "circles around one centre": levels,
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
