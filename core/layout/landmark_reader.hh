#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.hh"
#include "base/types.hh"

namespace layout_embedding {

struct Landmarks {
    /// Target vertex ids, in the order of the file; not yet compared with any target.
    std::vector<Index> vertices;
    /// Their names, "" for none; no list at all in formats without names.
    std::vector<std::string> names;
    /// What the user should know though it is no error, one sentence each.
    std::vector<std::string> notes;
};

/// Reads a landmark file: per line one 0-based target vertex id, or `id x y z` (.vts), of which the
/// id counts. `#` starts a comment; blank lines do not count. Where `positions`, the target's, are
/// given, ids that lie elsewhere than their x y z says (by more than 1e-4 of the target's size) are
/// noted. Files that begin with { or [ are JSON (layout/landmark_json.hh), with < picked points of
/// MeshLab (.pp); points without an id go to the nearest vertices (layout/landmark_points.hh).
/// `subject` begins the messages, for example "the landmark file spot.txt". Errors: fileEmpty, and
/// with the place: syntaxError, landmarkOutOfRange (negative, or no 32-bit id); for points
/// landmarkNeedsTarget, landmarkCount and nonFinitePosition.
Result<Landmarks> read_landmarks(std::string_view bytes, std::string_view subject,
                                 std::span<const Vec3> positions = {});

/// The same as one id per line.
std::string write_landmarks(std::span<const Index> vertices);

}  // namespace layout_embedding
