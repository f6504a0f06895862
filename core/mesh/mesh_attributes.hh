#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/types.hh"
#include "mesh/face_origins.hh"
#include "mesh/polygon_mesh.hh"

namespace layout_embedding {

/// What readers note for a value that a file announces and that cannot be used.
inline constexpr Index kUnusable = kNone - 1;

/// Values at the corners of faces. Corners share a value, or differ where they belong to one vertex
/// (a seam).
struct CornerValues {
    /// Numbers per value.
    Index size = 0;
    /// `size` finite numbers per value.
    std::vector<double> numbers;
    /// Per corner of the mesh the id of its value, kNone for none; empty where no corner has one.
    std::vector<Index> ids;

    bool empty() const { return ids.empty(); }
    Index count() const { return size == 0 ? 0 : static_cast<Index>(numbers.size() / size); }
    std::span<const double> value(Index id) const
    {
        return {numbers.data() + std::size_t{id} * size, size};
    }
    /// Appends a value and returns its id.
    Index add(std::span<const double> value);
    /// Makes `value`, `size` long, what lies between the values `from` with those weights; false
    /// where one that counts is kNone.
    bool mix(std::span<const Index, 3> from, const std::array<double, 3>& weights,
             std::span<double> value) const;
};

/// Names of faces.
struct FaceNames {
    std::vector<std::string> names;
    /// Per face the place of its name, kNone for none; empty where no face has one.
    std::vector<Index> ids;

    bool empty() const { return ids.empty(); }
    /// The name of a face, "" for none.
    std::string_view of_face(Index f) const;
};

/// What a file says of a mesh besides its surface.
struct MeshAttributes {
    /// 2 numbers: u to the right, v upwards.
    CornerValues texture_coordinates;
    /// 3 or 4 numbers, from 0 to 1 by convention: red, green, blue, opacity.
    CornerValues colours;
    /// Names of one or more words, a blank between them, each of which is a group.
    FaceNames groups;
    FaceNames materials;
    /// The files (OBJ) that define the materials.
    std::vector<std::string> material_files;
    /// Corners whose values cannot be used, since they are no finite numbers, too few, or not
    /// there.
    std::size_t unusable = 0;

    /// Whether there is nothing of all this.
    bool empty() const
    {
        return texture_coordinates.empty() && colours.empty() && groups.empty() &&
               materials.empty();
    }
};

/// Collects the names of faces in the order of the faces.
class FaceNaming {
public:
    /// Gives the next face a name, "" for none. O(log n).
    void add(const std::string& name);
    FaceNames take() { return std::move(result_); }

private:
    FaceNames result_;
    std::map<std::string, Index> ids_;
};

/// `text` with everything that would end a word in a line of text replaced by `_`.
std::string as_word(std::string_view text);

/// The word for a colour of faces, of red, green and blue from 0 to 1: "colour_ff8000". Files mark
/// regions that way.
std::string colour_word(const std::array<double, 3>& colour);

/// Ids for all corners of a mesh from those of its vertices.
std::vector<Index> corner_ids(std::span<const Index> vertex_ids, std::span<const Index> corners);

/// What readers do last: unusable values are counted and become none, and lists without anything
/// become empty. #C ids or none, #F names or none; ids may be kNone, kUnusable, or too large.
void finish(MeshAttributes& attributes);

/// Per vertex the value of its first corner that has one, else kNone. `corners` are those of the
/// mesh.
std::vector<Index> values_of_vertices(const CornerValues& values, std::span<const Index> corners,
                                      Index vertex_count);

/// The attributes of `before` on the mesh that a repair made of it: on faces that were flipped,
/// what lay there. O(#C).
MeshAttributes through_repair(const MeshAttributes& attributes, const PolygonMesh& before,
                              const FaceOrigins& origins);

}  // namespace layout_embedding
