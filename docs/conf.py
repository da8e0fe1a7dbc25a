"""The book: all of docs/ as one site. `bash docs/book.sh` makes it."""

project = "Delone"
author = "The Delone developers"
extensions = ["myst_parser"]
myst_enable_extensions = ["colon_fence"]
myst_heading_anchors = 3
exclude_patterns = ["results", "figures", "gallery/*", "build"]
html_theme = "furo"
html_title = "Delone"
html_extra_path = []
# Nothing is fetched by who reads it.
html_theme_options = {"source_repository": "", "top_of_page_buttons": []}
nitpicky = True
