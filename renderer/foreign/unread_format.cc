// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/foreign/unread_format.h"

#include <algorithm>

namespace insitu {
namespace {

struct UnreadFormat {
  std::string_view endings;  // a blank behind each
  std::string_view magic;    // empty: none that is sure
  std::string_view advice;
};

constexpr UnreadFormat kUnread[] = {
    {".dwg .dwt .dws ", "AC10",
     "a DWG drawing: save it as DXF (AutoCAD: File > Save As > AutoCAD DXF; without AutoCAD, ODA "
     "File Converter)"},
    {".skp .skb ", "\xFF\xFE\xFF\x0E",
     "a SketchUp model: in SketchUp File > Export > 3D Model > COLLADA (.dae), glTF or IFC"},
    {".3dm ", "3D Geometry File Format",
     "a Rhino model: in Rhino File > Export Selected > OBJ, glTF or DXF"},
    {".rfa ", "", "a Revit family: load it into a project, there File > Export > IFC"},
    {".max ", "", "a 3ds Max scene: in 3ds Max File > Export > glTF or OBJ"},
    {".rvt .rte ", "\xD0\xCF\x11\xE0",
     "a Revit or other OLE file: in Revit File > Export > IFC, in 3ds Max File > Export > OBJ"},
    {".fbx ", "Kaydara FBX",
     "an FBX model: in Blender File > Import > FBX, then File > Export > glTF 2.0 or Wavefront "
     "(.obj)"},
    {"", "; FBX",
     "an FBX model as text: in its program export OBJ, glTF or a binary FBX for Blender"},
    {".3ds ", "",
     "a 3DS model: in MeshLab File > Import Mesh, then File > Export Mesh As > OBJ; in 3ds Max "
     "File "
     "> Import"},
    {".pln .tpl ", "", "an ArchiCAD project: in ArchiCAD File > Save As > IFC"},
    {".pla ", "", "an ArchiCAD archive: in ArchiCAD open it, then File > Save As > IFC"},
    {".vwx .mcd ", "", "a Vectorworks file: in Vectorworks File > Export > IFC Project or DXF/DWG"},
    {".ndw ", "", "an Allplan drawing: in Allplan File > Export > IFC Data"},
    {".nwd .nwc .nwf ", "", "a Navisworks file: ask for the IFC or DXF that it was made from"},
    {".dgn ", "\x08\x09\xFE\x02", "a MicroStation design: File > Export > DWG/DXF or IFC"},
    {".usd .usda .usdc ", "#usda",
     "a USD model: in Blender File > Import > Universal Scene Description, then File > Export > "
     "glTF 2.0"},
    {"", "PXR-USDC",
     "a USD model: in Blender File > Import > Universal Scene Description, then File > Export > "
     "glTF 2.0"},
    {".usdz ", "",
     "a USD model in a package: in Blender File > Import > Universal Scene Description, then File "
     "> "
     "Export > glTF 2.0"},
    {".kmz ", "",
     "a KMZ archive (Google Earth): unpack it as a zip archive, and take the .dae and images "
     "within"},
    {".kml ", "", "a KML file, which names models and holds none: take the .dae that it names"},
    {".zae ", "",
     "a zipped COLLADA: unpack it as a zip archive, and take the .dae and images within"},
    {".ifczip ", "", "a zipped IFC: unpack it as a zip archive, and take the .ifc within"},
    {".ifcxml ", "", "IFC as XML: export it as .ifc (STEP file)"},
    {".3mf ", "", "a 3MF model: in its program save it as STL or OBJ"},
    {".amf ", "", "an AMF model: in its program save it as STL or OBJ"},
    {".wrl .vrml ", "#VRML",
     "a VRML model: in MeshLab File > Import Mesh, then File > Export Mesh As > OBJ or PLY"},
    {".x3d .x3dv .x3db ", "",
     "an X3D model: in Blender File > Import > X3D, then File > Export > glTF 2.0 or OBJ"},
    {".off ", "OFF\n",
     "an OFF mesh: in MeshLab File > Import Mesh, then File > Export Mesh As > PLY"},
    {".blend .blend1 ", "BLENDER",
     "a Blender file: in Blender File > Export > glTF 2.0 or Wavefront (.obj)"},
    {".c4d ", "", "a Cinema 4D scene: in Cinema 4D File > Export > glTF or OBJ"},
    {".lwo .lws ", "", "a LightWave model: export OBJ or COLLADA"},
    {".ma .mb ", "", "a Maya scene: in Maya File > Export All > OBJ"},
    {".gml .citygml ", "",
     "a CityGML model: convert it to glTF, OBJ or COLLADA (3D City Database importer/exporter)"},
    {".cityjson ", "", "a CityJSON model: export it as OBJ (cjio: export obj)"},
    {".b3dm .i3dm .cmpt ", "b3dm", "a tile of 3D Tiles: take the glTF within"},
    {".step .stp ", "",
     "a STEP model: in FreeCAD open it, then File > Export > IFC, COLLADA or OBJ"},
    {".igs .iges ", "",
     "an IGES model: in FreeCAD open it, then File > Export > IFC, COLLADA or OBJ"},
    {".sat .sab .asat .asab ", "ACIS BinaryFile",
     "an ACIS body: read are those in DXF; import it into the CAD program and save as DXF"},
    {".jt .x_t .x_b .prt .sldprt .catpart .ipt .iam .sldasm .asm .3dxml .catproduct ", "",
     "a model of mechanical CAD: export IFC, OBJ or STL"},
    {".gsm .lcf ", "",
     "an ArchiCAD library part: place it in a project, there File > Save As > IFC"},
    {".dxb ", "AutoCAD DXB", "a DXB drawing without surfaces: save it as DXF"},
    {".u3d .prc ", "", "a model made for PDF documents: ask for IFC, DXF or glTF"},
    {".xkt .frag .svf .bimx ", "",
     "a model made for a viewer: ask for the IFC that it was made from"},
    {".splat .ksplat .spz ", "", "Gaussian splats without surfaces: ask for the model itself"},
    {".vtk .vtp .vtu ", "# vtk DataFile", "a VTK mesh: in ParaView File > Save Data > PLY or STL"},
    {".abc ", "Ogawa",
     "an Alembic scene: in Blender File > Import > Alembic, then File > Export > "
     "glTF 2.0"},
    {".layout ", "",
     "a LayOut document: ask for the SketchUp model that it shows, exported as COLLADA, glTF or "
     "IFC"},
    {".dwf .dwfx ", "(DWF V", "a DWF plot without surfaces: ask for DXF or IFC"},
    {".pdf ", "%PDF", "a PDF document: ask the architect for IFC, DXF or glTF"},
    {".las .laz ", "LASF", "a point cloud without surfaces: ask for the model itself"},
    {".e57 ", "ASTM-E57", "a point cloud without surfaces: ask for the model itself"},
    {".xyz .pts .ptx .pcd .rcp .rcs ", "# .PCD",
     "a point cloud without surfaces: ask for the model itself"},
    {".zip ", "PK\x03\x04", "a zip archive: unpack it into building/"},
    {".7z ", "7z\xBC\xAF", "an archive: unpack it into building/"},
    {".rar ", "Rar!", "an archive: unpack it into building/"},
    {".gz .tgz ", "\x1F\x8B", "a packed file: unpack it into building/"},
    {".tar .xz .bz2 .zst ",
     "\xFD"
     "7zXZ",
     "an archive: unpack it into building/"},
    {"", "version https://git-lfs",
     "a pointer of Git LFS, not the file itself: fetch it (git lfs pull)"},
    {"", "<!DOCTYPE html", "a web page, not a model: was the download a page to log in?"},
    {"", "<!doctype html", "a web page, not a model: was the download a page to log in?"},
    {"", "<html", "a web page, not a model: was the download a page to log in?"}};

bool IsOneOf(std::string_view endings, std::string_view ending) {
  if (ending.size() < 2) return false;
  for (size_t at = endings.find(ending); at != endings.npos; at = endings.find(ending, at + 1)) {
    if (endings[at + ending.size()] == ' ') return true;
  }
  return false;
}

// "MM" begins TIFF, too: its chunk's length is that of the file.
bool Is3ds(std::string_view head) {
  constexpr size_t kChunk = 6;
  return head.size() >= kChunk && head.starts_with("MM") &&
         !head.starts_with(std::string_view("MM\0*", 4));
}

}  // namespace

std::string AdviceOnFormat(std::string_view head, std::string_view ending) {
  // What is told by its content alone goes before endings, which may lie.
  for (const UnreadFormat& format : kUnread) {
    if (format.endings.empty() && head.starts_with(format.magic)) return std::string(format.advice);
  }
  for (const UnreadFormat& format : kUnread) {
    if (IsOneOf(format.endings, ending)) return std::string(format.advice);
  }
  for (const UnreadFormat& format : kUnread) {
    if (!format.magic.empty() && head.starts_with(format.magic)) return std::string(format.advice);
  }
  if (Is3ds(head)) return AdviceOnFormat("", ".3ds");
  return "";
}

}  // namespace insitu
