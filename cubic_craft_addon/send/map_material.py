# SPDX-License-Identifier: GPL-3.0-or-later
"""Materials that show a normal map: copies of the artist's, or a plain one."""

from typing import Any

import bpy


class MapMaterials:
    """The materials of a low-poly mesh, with the image as a node that is not connected yet.

    Baking needs the node, and must not find it connected: the map would depend on itself.
    """

    def __init__(self, mesh: bpy.types.Mesh, image: bpy.types.Image):
        self._mesh = mesh
        self._image = image
        self._made: list[bpy.types.Material] = []
        self._nodes: list[tuple[bpy.types.Material, Any]] = []

    def add(self, name: str) -> None:
        """Put copies on the mesh, and one of this name where there is no material."""
        slots: Any = self._mesh.materials
        if not slots:
            slots.append(None)
        copies: dict[Any, bpy.types.Material] = {}
        for number, source in enumerate(list(slots)):
            if source not in copies:
                copies[source] = self._add(source, name)
            slots[number] = copies[source]

    def connect(self, uv_map: str, *, is_rendered: bool) -> list[str]:
        """Let all shaders use the map; return the materials without a shader that could.

        `is_rendered`: whether it is the UV map that textures use when they name none.
        """
        plain = []
        for material, texture in self._nodes:
            tree: Any = material.node_tree
            shaders = [
                node
                for node in tree.nodes
                if node.bl_idname.startswith("ShaderNodeBsdf") and "Normal" in node.inputs
            ]
            if not shaders:
                plain.append(material.name)
                continue
            x, y = shaders[0].location
            texture.location = x - 560, y - 400
            normal = tree.nodes.new("ShaderNodeNormalMap")
            normal.location = x - 220, y - 400
            normal.uv_map = uv_map
            tree.links.new(texture.outputs["Color"], normal.inputs["Color"])
            for shader in shaders:
                tree.links.new(normal.outputs["Normal"], shader.inputs["Normal"])
            if not is_rendered:
                places = tree.nodes.new("ShaderNodeUVMap")
                places.location = x - 780, y - 400
                places.uv_map = uv_map
                tree.links.new(places.outputs["UV"], texture.inputs["Vector"])
        return plain

    def remove(self) -> None:
        """Remove them."""
        for material in self._made:
            bpy.data.materials.remove(material)

    def _add(self, source: bpy.types.Material | None, name: str) -> bpy.types.Material:
        material: Any = bpy.data.materials.new(name) if source is None else source.copy()
        self._made.append(material)
        if source is not None:
            material.name = f"{source.name} Low"
        if bpy.app.version < (5, 0):  # later, all materials use nodes
            material.use_nodes = True
        texture = material.node_tree.nodes.new("ShaderNodeTexImage")
        texture.image = self._image
        for node in material.node_tree.nodes:
            node.select = node == texture
        material.node_tree.nodes.active = texture
        self._nodes.append((material, texture))
        return material
