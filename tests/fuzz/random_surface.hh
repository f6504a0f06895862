#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <utility>
#include <vector>

#include "mesh/polygon_mesh.hh"

namespace layout_embedding {

/// Bytes one after the other, zeros after the last.
class Bytes {
public:
    Bytes(const std::uint8_t* data, std::size_t size) : at_(data), end_(data + size) {}
    Index below(std::size_t count) { return at_ == end_ ? 0 : static_cast<Index>(*at_++ % count); }

private:
    const std::uint8_t* at_;
    const std::uint8_t* end_;
};

/// The faces of a surface, of any number of corners.
struct RandomFaces {
    std::vector<Vec3> positions;
    std::vector<std::vector<Index>> faces;

    /// Leaves out so many faces, if they share no corners: one hole each.
    void leave_out(Bytes& bytes, Index holes)
    {
        std::vector<bool> on_rim(positions.size(), false);
        for (Index hole = 0; hole < holes; ++hole) {
            const Index place = bytes.below(faces.size());
            const std::vector<Index> face = faces[place];
            if (std::none_of(face.begin(), face.end(), [&](Index v) { return on_rim[v]; })) {
                faces.erase(faces.begin() + place);
                for (const Index v : face) {
                    on_rim[v] = true;
                }
            }
        }
    }

    /// Makes one face of two, up to so many times. What remains of edges between the same two faces
    /// dangles in the new one.
    void merge(Bytes& bytes, Index merges)
    {
        for (Index i = 0; i < merges; ++i) {
            const Index place = bytes.below(faces.size());
            std::vector<Index>& face = faces[place];
            std::rotate(face.begin(), face.begin() + bytes.below(face.size()), face.end());
            for (Index other = 0; other < faces.size(); ++other) {
                if (other != place && append_across(face, faces[other])) {
                    faces.erase(faces.begin() + other);
                    break;
                }
            }
        }
    }

    PolygonMesh mesh() const
    {
        PolygonMesh mesh;
        mesh.positions = positions;
        for (const auto& face : faces) {
            mesh.add_face(face);
        }
        return mesh;
    }

private:
    /// Whether `other` has the edge from the last to the first corner of `face` in the other
    /// direction; its corners then come behind those of `face`.
    static bool append_across(std::vector<Index>& face, std::vector<Index>& other)
    {
        for (std::size_t turn = 0; turn < other.size(); ++turn) {
            if (other.front() == face.front() && other[1] == face.back()) {
                face.insert(face.end(), other.begin() + 2, other.end());
                return true;
            }
            std::rotate(other.begin(), other.begin() + 1, other.end());
        }
        return false;
    }
};

/// A closed surface of triangles, without loops and parallel edges, that grows by splits, shrinks
/// by collapses and changes by flips. Shares nothing with the meshes of the library.
class RandomSurface {
public:
    static RandomSurface sphere()
    {
        return {{{1, 1, 1}, {-1, -1, 1}, {-1, 1, -1}, {1, -1, -1}},
                {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
    }

    /// 3 by 3 vertices.
    static RandomSurface torus()
    {
        std::vector<Vec3> positions;
        std::vector<std::array<Index, 3>> faces;
        for (Index i = 0; i < 3; ++i) {
            for (Index j = 0; j < 3; ++j) {
                const double u = 2 * std::numbers::pi / 3 * i;
                const double v = 2 * std::numbers::pi / 3 * j;
                const double radius = 1 + 0.4 * std::cos(v);
                positions.emplace_back(radius * std::cos(u), radius * std::sin(u),
                                       0.4 * std::sin(v));
                const Index a = 3 * i + j;
                const Index b = 3 * ((i + 1) % 3) + j;
                const Index c = 3 * ((i + 1) % 3) + (j + 1) % 3;
                const Index d = 3 * i + (j + 1) % 3;
                faces.push_back({a, b, c});
                faces.push_back({a, c, d});
            }
        }
        return {std::move(positions), std::move(faces)};
    }

    /// So many operations anywhere.
    void change(Bytes& bytes, Index steps)
    {
        for (Index i = 0; i < steps; ++i) {
            const Index face = bytes.below(faces_.size());
            const Index kind = bytes.below(16);
            std::rotate(faces_[face].begin(), faces_[face].begin() + kind % 3, faces_[face].end());
            if (kind < 8) {
                split(face, 0.05 * (kind + 1));
            } else if (kind < 12) {
                flip(face);
            } else {
                collapse(face);
            }
        }
    }

    RandomFaces faces() const
    {
        RandomFaces result{positions_, {}};
        for (const auto& face : faces_) {
            result.faces.emplace_back(face.begin(), face.end());
        }
        return result;
    }

private:
    RandomSurface(std::vector<Vec3> positions, std::vector<std::array<Index, 3>> faces)
        : positions_(std::move(positions)), faces_(std::move(faces))
    {}

    /// A vertex inside a face, off its plane by a part of `offset`.
    void split(Index face, double offset)
    {
        const auto [a, b, c] = faces_[face];
        const Vec3 normal =
            (positions_[b] - positions_[a]).cross(positions_[c] - positions_[a]).normalized();
        const auto v = static_cast<Index>(positions_.size());
        positions_.push_back((positions_[a] + positions_[b] + positions_[c]) / 3 + offset * normal);
        faces_[face] = {a, b, v};
        faces_.push_back({b, c, v});
        faces_.push_back({c, a, v});
    }

    /// Turns the edge after a face's first corner, unless the new edge is there already.
    void flip(Index face)
    {
        const auto [a, b, c] = faces_[face];
        for (Index other = 0; other < faces_.size(); ++other) {
            for (int turn = 0; turn < 3; ++turn) {
                const auto [p, q, d] = faces_[other];
                if (p == b && q == a && !has_edge(c, d)) {
                    faces_[other] = {c, d, b};
                    faces_[face] = {d, c, a};
                    return;
                }
                std::rotate(faces_[other].begin(), faces_[other].begin() + 1, faces_[other].end());
            }
        }
    }

    /// Makes the first two corners of a face one vertex, unless that would change the topology: the
    /// two have no neighbours in common but those across from their edge.
    void collapse(Index face)
    {
        const Index kept = faces_[face][0];
        const Index removed = faces_[face][1];
        Index common = 0;
        for (Index v = 0; v < positions_.size(); ++v) {
            common +=
                v != kept && v != removed && has_edge(v, kept) && has_edge(v, removed) ? 1 : 0;
        }
        if (common != 2 || positions_.size() == 4) {
            return;
        }
        std::erase_if(faces_, [&](const auto& each) {
            return has_corner(each, kept) && has_corner(each, removed);
        });
        positions_.erase(positions_.begin() + removed);
        for (auto& each : faces_) {
            for (Index& v : each) {
                v = v == removed ? kept : v;
                v -= v > removed ? 1 : 0;
            }
        }
    }

    static bool has_corner(const std::array<Index, 3>& face, Index v)
    {
        return std::find(face.begin(), face.end(), v) != face.end();
    }

    bool has_edge(Index a, Index b) const
    {
        return std::any_of(faces_.begin(), faces_.end(), [&](const auto& face) {
            return has_corner(face, a) && has_corner(face, b);
        });
    }

    std::vector<Vec3> positions_;
    std::vector<std::array<Index, 3>> faces_;
};

}  // namespace layout_embedding
