#pragma once

#include <array>
#include <cstddef>
#include <numeric>
#include <vector>

#include "base/types.hh"

namespace layout_embedding {

/// Where the faces of a mended mesh come from.
class FaceOrigins {
public:
    /// Barycentric coordinates of three points.
    using Places = std::array<std::array<double, 3>, 3>;

    /// Every face is itself.
    explicit FaceOrigins(Index face_count) : faces_(face_count), places_ids_(face_count, kNone)
    {
        std::iota(faces_.begin(), faces_.end(), Index{0});
    }

    Index face_count() const { return static_cast<Index>(faces_.size()); }
    /// The face of the mesh before that face f is, or lies in.
    Index face(Index f) const { return faces_[f]; }
    /// Whether face f has the corners of face(f), in the same order.
    bool is_whole(Index f) const { return places_ids_[f] == kNone; }
    /// Where the three corners of f lie in the triangle face(f).
    Places places(Index f) const
    {
        return is_whole(f) ? Places{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}} : places_[places_ids_[f]];
    }

    /// Face f becomes a part of the triangle `face` of the mesh before.
    void set(Index f, Index face, const Places& places)
    {
        faces_[f] = face;
        places_ids_[f] = static_cast<Index>(places_.size());
        places_.push_back(places);
    }

    /// Leaves the faces that `keep` is true of, in their order.
    template <typename Keep>
    void keep_if(Keep keep)
    {
        Index count = 0;
        for (Index f = 0; f < face_count(); ++f) {
            if (keep(f)) {
                faces_[count] = faces_[f];
                places_ids_[count++] = places_ids_[f];
            }
        }
        faces_.resize(count);
        places_ids_.resize(count);
    }

private:
    std::vector<Index> faces_;
    std::vector<Index> places_ids_;
    std::vector<Places> places_;
};

}  // namespace layout_embedding
