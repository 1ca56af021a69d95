"""The rooms of ``headless_render.py``: read, cubify, save, picture and report."""
