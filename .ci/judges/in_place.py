"""A plugin of pytest: tests of others with Delone in SciPy's place."""

import delone.scipy

# Entered for good, before anything of theirs is imported.
delone.scipy.patched().__enter__()
