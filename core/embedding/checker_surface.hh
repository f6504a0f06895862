#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/types.hh"
#include "embedding/checker.hh"

/// Parts of the checker (embedding/checker.hh); nothing else uses them.
namespace layout_embedding::checker {

/// The violations found so far, at most kMaxViolationsPerCode of each code.
class Violations {
public:
    /// Adds a violation whose message is `parts`, strings and ids, put together.
    template <typename... Parts>
    void add(std::string_view code, const Parts&... parts)
    {
        if (count(code)) {
            std::string message;
            (append(message, parts), ...);
            list_.push_back({std::string(code), std::move(message)});
        }
    }

    /// How many were reported, those left out of the list included.
    std::size_t total() const { return total_; }
    std::vector<Violation>& list() { return list_; }

private:
    /// Counts one more of this code; false when there are enough of them.
    bool count(std::string_view code);
    static void append(std::string& message, std::string_view part) { message += part; }
    static void append(std::string& message, Index id) { message += std::to_string(id); }

    std::vector<Violation> list_;
    std::vector<std::pair<std::string, std::size_t>> counts_;
    std::size_t total_ = 0;
};

/// An oriented manifold surface of polygons, made closed: every hole is filled with one more face,
/// its cap.
///
/// The halfedges of the polygons come first, in the order of `corners` (so that halfedge 3f+i of a
/// triangle mesh starts at corner i of face f); those of the caps follow. Every halfedge has a twin
/// and a face on its left.
///
/// Turning clockwise around a vertex goes from outgoing halfedge h to clockwise(h) and from
/// face(h) to face(clockwise(h)), across the edge of h.
struct Surface {
    Index vertex_count = 0;
    /// Polygons; the caps are the faces polygon_count .. polygon_count + cap_count - 1.
    Index polygon_count = 0;
    Index cap_count = 0;
    /// Halfedges of polygons.
    Index corner_count = 0;

    std::vector<Index> tails;           // per halfedge
    std::vector<Index> twins;           // per halfedge
    std::vector<Index> nexts;           // per halfedge
    std::vector<Index> faces;           // per halfedge
    std::vector<Index> face_halfedges;  // per face, caps included
    /// Per vertex: an outgoing halfedge, at a boundary vertex the one with the cap on its left.
    std::vector<Index> outgoing;

    Index halfedge_count() const { return static_cast<Index>(tails.size()); }
    Index head(Index h) const { return tails[twins[h]]; }
    Index clockwise(Index h) const { return nexts[twins[h]]; }
    bool is_cap(Index face) const { return face >= polygon_count; }
    bool is_boundary_vertex(Index v) const { return is_cap(faces[outgoing[v]]); }
    /// The same halfedge for both directions of an edge; it belongs to a polygon.
    Index edge(Index h) const { return h < twins[h] ? h : twins[h]; }
    /// V - E + F of the closed surface.
    long long euler_characteristic() const
    {
        return static_cast<long long>(vertex_count) - halfedge_count() / 2 + polygon_count +
               cap_count;
    }

    /// The halfedge from a to b, kNone if there is none. Takes as long as the smaller of the two
    /// valences.
    Index find(Index a, Index b) const;
};

/// Builds `surface` from polygons given as in PolygonMesh. False, with violations of the given code
/// whose messages begin with `subject`, unless the arrays make sense and the polygons form one
/// connected, oriented manifold surface that uses every vertex and whose polygons have three or
/// more different corners. Linear but for sorting the edges at each vertex.
bool build_surface(Index vertex_count, std::span<const Index> face_offsets,
                   std::span<const Index> corners, std::string_view code, std::string_view subject,
                   Violations& violations, Surface& surface);

}  // namespace layout_embedding::checker
