// SPDX-License-Identifier: GPL-3.0-or-later
// Small models in every format that is text.
#pragma once

namespace insitu {

inline constexpr char kObj[] = R"(# a house on a national grid
mtllib house.mtl
o house
v 2600000.123456 1200000.654321 430.5
v 2600004.123456 1200000.654321 430.5
v 2600004.123456 1200003.654321 430.5
v 2600000.123456 1200003.654321 430.5
vt 0 0
vt 1 0
vt 1 1
vn 0 0 1
usemtl BRICK
f 1/1/1 2/2/1 3/3/1 \
  4//1
g roof
f -4 -3 -2
l 1 2
)";

inline constexpr char kPly[] = R"(ply
format ascii 1.0
element vertex 4
property float x
property float y
property float z
element face 4
property list uchar int vertex_indices
end_header
0 0 0
1 0 0
0 1 0
0 0 1
3 0 2 1
3 0 1 3
3 0 3 2
3 1 2 3
)";

inline constexpr char kStl[] = R"(solid tetra
facet normal 0 0 -1
 outer loop
  vertex 0 0 0
  vertex 0 1 0
  vertex 1 0 0
 endloop
endfacet
endsolid tetra
)";

// One triangle in a node "Wall" that stands 5 m along x; glTF has y up.
inline constexpr char kGltf[] =
    R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
 "nodes": [{"mesh": 0, "name": "Wall", "translation": [5, 0, 0]}],
 "materials": [{"name": "Red", "pbrMetallicRoughness": {"baseColorFactor": [0.5, 0, 0, 1]}}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "material": 0}]}],
 "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3",
                "min": [0, 0, 0], "max": [1, 2, 0]}],
 "bufferViews": [{"buffer": 0, "byteLength": 36}],
 "buffers": [{"byteLength": 36, "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAAEAAAAAA"}]})";

inline constexpr char kCollada[] = R"(<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
 <asset><unit meter="0.001" name="millimeter"/><up_axis>Z_UP</up_axis></asset>
 <library_geometries><geometry id="g" name="g"><mesh>
  <source id="p"><float_array id="pa" count="9">0 0 0 1000 0 0 0 0 2000</float_array>
   <technique_common><accessor source="#pa" count="3" stride="3"><param name="X" type="float"/>
    <param name="Y" type="float"/><param name="Z" type="float"/></accessor></technique_common>
  </source><vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
  <triangles count="1"><input semantic="VERTEX" source="#v" offset="0"/><p>0 1 2</p></triangles>
 </mesh></geometry></library_geometries>
 <library_visual_scenes><visual_scene id="s"><node id="n" name="Gate">
  <instance_geometry url="#g"/></node></visual_scene></library_visual_scenes>
 <scene><instance_visual_scene url="#s"/></scene>
</COLLADA>
)";

}  // namespace insitu
