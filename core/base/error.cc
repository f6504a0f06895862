#include "base/error.hh"

namespace layout_embedding {

const std::vector<ErrorInfo>& all_error_infos()
{
    using enum ErrorCode;
    static const std::vector<ErrorInfo> table = {
        {none, "none", "no error", "nothing to do"},
        {fileEmpty, "fileEmpty", "the file is missing or holds nothing",
         "check the path and export the file again"},
        {unknownFormat, "unknownFormat", "the file is not in a format that can be read",
         "save it as OBJ, OFF, PLY, STL or GLB"},
        {syntaxError, "syntaxError", "a line of the file cannot be understood",
         "correct the line or export the file again"},
        {indexOutOfRange, "indexOutOfRange", "a face refers to a vertex that does not exist",
         "correct the index or export the file again"},
        {faceTooLarge, "faceTooLarge", "a face has more than 255 corners",
         "split it into smaller faces"},
        {tooLarge, "tooLarge", "the input is larger than the library can handle",
         "simplify the mesh first"},
        {noFaces, "noFaces", "there is no face", "use a surface mesh, not points or lines"},
        {notTriangles, "notTriangles", "the target has a face that is not a triangle",
         "triangulate the target first"},
        {nonFinitePosition, "nonFinitePosition", "a coordinate is not a finite number",
         "correct the coordinate or export the file again"},
        {coordinateTooLarge, "coordinateTooLarge",
         "a coordinate is too large, or the whole mesh too small, to compute lengths with",
         "scale the mesh to a sensible unit"},
        {degenerateFace, "degenerateFace", "a face has a repeated corner or no area",
         "remove it or repair the mesh (--repair)"},
        {duplicateFace, "duplicateFace", "two faces have the same corners",
         "remove one of them or repair the mesh (--repair)"},
        {coincidentVertices, "coincidentVertices", "vertices lie at exactly the same position",
         "weld them or repair the mesh (--repair)"},
        {unusedVertex, "unusedVertex", "a vertex belongs to no face",
         "remove it or repair the mesh (--repair)"},
        {nonManifoldEdge, "nonManifoldEdge", "an edge has more than two faces",
         "remove the extra faces so that the mesh is a surface"},
        {nonManifoldVertex, "nonManifoldVertex", "the faces around a vertex form more than one fan",
         "split the vertex so that the mesh is a surface"},
        {inconsistentOrientation, "inconsistentOrientation",
         "two neighbouring faces are oriented in opposite ways",
         "orient all faces counter-clockwise seen from outside"},
        {severalComponents, "severalComponents", "the mesh has more than one component",
         "keep one component"},
        {layoutLoop, "layoutLoop", "a layout edge joins a vertex to itself",
         "split the edge with another layout vertex"},
        {landmarkCount, "landmarkCount",
         "the number of landmarks differs from the number of layout vertices",
         "give one landmark per layout vertex"},
        {landmarkOutOfRange, "landmarkOutOfRange", "a landmark is not a vertex of the target",
         "use 0-based vertex ids of the target"},
        {duplicateLandmark, "duplicateLandmark", "two landmarks fall on one target vertex",
         "move one of them to another vertex"},
        {landmarkOnBoundary, "landmarkOnBoundary",
         "the landmark of an inner layout vertex lies on the boundary of the target",
         "move it off the boundary"},
        {topologyMismatch, "topologyMismatch",
         "the layout and the target are surfaces of different type",
         "use a layout and a target of the same genus, with holes only where the layout has them"},
        {tooFewLandmarks, "tooFewLandmarks", "the layout has fewer than three vertices",
         "add layout vertices"},
        {invalidOption, "invalidOption", "an option has a value that makes no sense",
         "correct the option"},
        {memoryLimit, "memoryLimit", "the work needs more memory than allowed",
         "raise the limit or simplify the target"},
        {unresolvedTie, "unresolvedTie", "paths of equal length could not be told apart",
         "try another seed"},
        {realisationFailed, "realisationFailed", "the paths could not be turned into mesh edges",
         "report this input as a bug"},
        {internal, "internal", "something went wrong that should not",
         "report this input as a bug"},
        {tooFewLandmarksForSurface, "tooFewLandmarksForSurface",
         "the target has too many handles or holes for a triangulation with so few vertices",
         "add landmarks"},
        {templateNotReached, "templateNotReached",
         "the target could not be collapsed onto its landmarks alone", "add or move landmarks"},
        {parametrisationFailed, "parametrisationFailed",
         "a patch could not be mapped to the plane without flipped triangles",
         "add layout edges that divide the patch"},
        {landmarkNeedsTarget, "landmarkNeedsTarget",
         "landmarks are given as points, and there is no target that they could lie on, or one "
         "that "
         "was repaired",
         "load the target first, without repair"},
        {invalidPath, "invalidPath",
         "a path that an edge is to keep or to avoid is not on the target",
         "take the weak path of an earlier embedding with the same target and landmarks"},
    };
    return table;
}

const ErrorInfo& error_info(ErrorCode code)
{
    const auto& table = all_error_infos();
    const auto index = static_cast<std::size_t>(code);
    return table[index < table.size() ? index : static_cast<std::size_t>(ErrorCode::internal)];
}

Error make_error(ErrorCode code, std::string what_and_where,
                 std::vector<std::pair<std::string, std::int64_t>> details)
{
    what_and_where += "; ";
    what_and_where += error_info(code).advice;
    what_and_where += '.';
    return Error{code, std::move(what_and_where), std::move(details)};
}

}  // namespace layout_embedding
