#include "mesh/repair.hh"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "mesh/area_repair.hh"
#include "mesh/duplicate_faces.hh"
#include "mesh/weld.hh"

namespace layout_embedding {
namespace {

std::string counted(std::size_t count, const std::string& one, const std::string& many)
{
    return std::to_string(count) + " " + (count == 1 ? one : many);
}

class Repair {
public:
    Repair(const PolygonMesh& mesh, SurfaceKind kind)
        : mesh_(mesh),
          target_(kind == SurfaceKind::target),
          vertex_map_(mesh.vertex_count()),
          face_origins_(mesh.face_count())
    {
        std::iota(vertex_map_.begin(), vertex_map_.end(), 0);
    }

    RepairResult run()
    {
        // Unused vertices first: their positions can be anything.
        compact();
        drop_thin_faces();
        drop_duplicates();
        if (target_ && positions_are_usable() && mesh_.face_count() > 0) {
            weld();
            mend_areas();
        }
        compact();
        const auto dropped = std::count(vertex_map_.begin(), vertex_map_.end(), kNone);
        if (dropped > 0) {
            note("Dropped " +
                 counted(static_cast<std::size_t>(dropped), "vertex that belongs",
                         "vertices that belong") +
                 " to no face.");
        }
        return {std::move(mesh_), std::move(vertex_map_), std::move(face_origins_),
                std::move(notes_)};
    }

private:
    void note(std::string text) { notes_.push_back(std::move(text)); }

    template <typename Keep>
    std::size_t keep_faces(Keep keep)
    {
        PolygonMesh result;
        for (Index f = 0; f < mesh_.face_count(); ++f) {
            if (keep(f)) {
                result.add_face(mesh_.face(f));
            }
        }
        const std::size_t dropped = mesh_.face_count() - result.face_count();
        if (dropped > 0) {
            face_origins_.keep_if(keep);
            result.positions = std::move(mesh_.positions);
            mesh_ = std::move(result);
        }
        return dropped;
    }

    /// A face is thin if it goes to a second corner and back.
    bool is_thin(Index f) const
    {
        const auto face = mesh_.face(f);
        std::size_t different = 0;
        for (std::size_t i = 0; i < face.size(); ++i) {
            different += face[i] != face[(i + 1) % face.size()] ? 1 : 0;
        }
        return different < 3;
    }

    void drop_thin_faces()
    {
        const std::size_t dropped = keep_faces([&](Index f) { return !is_thin(f); });
        if (dropped > 0) {
            note("Dropped " + counted(dropped, "face", "faces") +
                 " with fewer than three different corners.");
        }
    }

    void drop_duplicates()
    {
        const auto duplicates = duplicate_faces(mesh_);
        if (duplicates.empty() || is_pillow()) {
            return;
        }
        std::vector<bool> dropped(mesh_.face_count(), false);
        for (const auto& pair : duplicates) {
            dropped[pair[1]] = true;
        }
        reorient(duplicates, dropped);
        note("Dropped " + counted(duplicates.size(), "duplicate face", "duplicate faces") + ".");
        keep_faces([&](Index f) { return !dropped[f]; });
    }

    /// Two faces glued along their whole boundary: the smallest layout of a sphere.
    bool is_pillow() const
    {
        return !target_ && mesh_.face_count() == 2 && !same_direction(mesh_.face(0), mesh_.face(1));
    }

    /// Of faces that run both ways around the same corners, keeps the one that runs against its
    /// neighbours, as it should.
    void reorient(const std::vector<std::array<Index, 2>>& duplicates, std::vector<bool>& dropped)
    {
        std::vector<bool> involved = dropped;
        for (const auto& pair : duplicates) {
            involved[pair[0]] = true;
        }
        std::vector<std::array<Index, 2>> directed;  // the edges of all other faces
        for (Index f = 0; f < mesh_.face_count(); ++f) {
            const auto face = mesh_.face(f);
            for (std::size_t i = 0; !involved[f] && i < face.size(); ++i) {
                directed.push_back({face[i], face[(i + 1) % face.size()]});
            }
        }
        std::sort(directed.begin(), directed.end());
        const auto conflicts = [&](Index f) {
            const auto face = mesh_.face(f);
            std::size_t count = 0;
            for (std::size_t i = 0; i < face.size(); ++i) {
                count +=
                    std::binary_search(directed.begin(), directed.end(),
                                       std::array<Index, 2>{face[i], face[(i + 1) % face.size()]})
                        ? 1
                        : 0;
            }
            return count;
        };
        for (const auto& [first, duplicate] : duplicates) {
            if (!dropped[first] && conflicts(duplicate) < conflicts(first)) {
                dropped[first] = true;
                dropped[duplicate] = false;
            }
        }
    }

    bool positions_are_usable() const
    {
        constexpr double kLargest = 1e60;
        return std::all_of(mesh_.positions.begin(), mesh_.positions.end(), [](const Vec3& p) {
            return p.allFinite() && p.cwiseAbs().maxCoeff() <= kLargest;
        });
    }

    void weld()
    {
        const std::vector<Index> classes = weld_classes(mesh_);
        std::size_t count = 0;
        for (Index v = 0; v < classes.size(); ++v) {
            count += classes[v] != v ? 1 : 0;
        }
        if (count == 0 || !welding_helps(mesh_, classes)) {
            return;
        }
        mesh_ = welded(mesh_, classes);
        follow(classes);
        note("Made one vertex of those at the same position: " +
             counted(count, "vertex was", "vertices were") + " joined to others.");
        drop_thin_faces();
        drop_duplicates();
    }

    void mend_areas()
    {
        for (Index f = 0; f < mesh_.face_count(); ++f) {
            if (mesh_.face(f).size() != 3) {
                return;
            }
        }
        std::vector<Index> representatives(mesh_.vertex_count());
        std::iota(representatives.begin(), representatives.end(), 0);
        const Index mended = mend_triangles_without_area(mesh_, representatives, face_origins_);
        for (Index v = 0; v < representatives.size(); ++v) {
            // Representatives have smaller ids, so theirs are final already.
            representatives[v] = representatives[representatives[v]];
        }
        follow(representatives);
        if (mended > 0) {
            note("Mended " + counted(mended, "triangle", "triangles") + " without area.");
        }
    }

    /// Updates the vertex map after vertices became others.
    void follow(const std::vector<Index>& new_ids)
    {
        for (Index& v : vertex_map_) {
            v = v == kNone ? kNone : new_ids[v];
        }
    }

    /// Drops the vertices that belong to no face.
    void compact()
    {
        std::vector<Index> new_ids(mesh_.vertex_count(), kNone);
        for (const Index v : mesh_.corners) {
            new_ids[v] = 0;
        }
        Index count = 0;
        for (Index v = 0; v < mesh_.vertex_count(); ++v) {
            if (new_ids[v] != kNone) {
                new_ids[v] = count;
                mesh_.positions[count] = mesh_.positions[v];
                ++count;
            }
        }
        mesh_.positions.resize(count);
        for (Index& v : mesh_.corners) {
            v = new_ids[v];
        }
        follow(new_ids);
    }

    PolygonMesh mesh_;
    bool target_;
    std::vector<Index> vertex_map_;
    FaceOrigins face_origins_;
    std::vector<std::string> notes_;
};

}  // namespace

RepairResult repair_surface(const PolygonMesh& mesh, SurfaceKind kind)
{
    const Status status = check_surface(mesh, kind, "the mesh");
    switch (status.error().code) {
        case ErrorCode::none:
        // What cannot be walked over is left alone.
        case ErrorCode::noFaces:
        case ErrorCode::tooLarge:
        case ErrorCode::indexOutOfRange: {
            RepairResult result{
                mesh, std::vector<Index>(mesh.vertex_count()), FaceOrigins(mesh.face_count()), {}};
            std::iota(result.vertex_map.begin(), result.vertex_map.end(), 0);
            return result;
        }
        default:
            return Repair(mesh, kind).run();
    }
}

}  // namespace layout_embedding
