# SPDX-License-Identifier: GPL-3.0-or-later
"""A layout that notes what is drawn into it, instead of Blender's."""


class Recorder:
    """Stands for a layout and for all rows, columns and boxes in it."""

    def __init__(self):
        self.drawn = []
        """identifiers of operators, names of properties and menus, in their order"""
        self.operators = {}
        """the text of each operator"""
        self.labels = []

    def operator(self, identifier, text=None, **_):
        self.drawn.append(identifier)
        self.operators[identifier] = text
        return Properties()

    def menu(self, name, **_):
        self.drawn.append(name)

    def prop(self, _data, name, **_):
        self.drawn.append(name)

    def template_icon_view(self, _data, name, *_others, **_):
        self.drawn.append(name)

    prop_search = template_icon_view

    def template_list(self, _kind, _id, _data, name, *_others, **_):
        self.drawn.append(name)

    def label(self, text="", **_):
        self.labels.append(text)

    def separator(self):
        pass

    def row(self, **_):
        return self

    box = column = split = row


class Properties:
    """Takes the properties that a button gives its operator."""
