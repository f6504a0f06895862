#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.hh"
#include "base/types.hh"
#include "layout/landmark_reader.hh"

namespace layout_embedding {

/// Reads landmarks from JSON:
/// - the project's own files, { "version": 1, "landmarks": [{ "name", "vertex", "position" }] },
///   where name and position may be missing; so may the vertex, where there is a position;
/// - a list of target vertex ids alone;
/// - markups of 3D Slicer (.mrk.json): the control points of the first markup that are placed.
/// `positions` and errors as for read_landmarks() in layout/landmark_reader.hh.
Result<Landmarks> read_landmark_json(std::string_view bytes, std::string_view subject,
                                     std::span<const Vec3> positions);

/// The project's own form. `names` and `positions`, the target's, may be empty.
std::string write_landmark_json(std::span<const Index> vertices, std::span<const std::string> names,
                                std::span<const Vec3> positions);

}  // namespace layout_embedding
