#include "apps/quad_mesh.hh"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "apps/base_complex.hh"
#include "apps/quad_relaxation.hh"
#include "embedding/refined_origin.hh"
#include "mesh/mesh_writer.hh"
#include "patches/parametrisation.hh"
#include "patches/patch.hh"
#include "patches/patch_shape.hh"
#include "patches/point_location.hh"

namespace layout_embedding {
namespace {

constexpr double kDefaultQuads = 4000;
/// About 2 GB.
constexpr double kMostVertices = 16'000'000;

}  // namespace

class QuadMeshJob::Mesher {
public:
    Mesher(const Layout& layout, const TriangleMesh& target, const RefinedMesh& refined,
           const QuadOptions& options)
        : layout_(layout),
          target_(target),
          refined_(refined),
          options_(options),
          base_(layout),
          origin_(target, refined)
    {}

    /// Everything but relaxation and what finish() adds.
    Status fill()
    {
        if (Status status = choose(); !status) {
            return status;
        }
        const auto patches = patches_of(layout_, refined_);
        if (!patches) {
            return patches.error();
        }
        find_chain_triangles();
        place_landmarks();
        place_chains();
        first_spoke_ = 2 * layout_.edge_count();
        for (const Patch& patch : *patches) {
            if (Status status = fill(patch); !status) {
                return status;
            }
        }
        describe();
        return {};
    }

    QuadMesh& mesh() { return mesh_; }

    /// The landmarks, and chains on the boundary of the layout.
    std::vector<bool> fixed_vertices() const
    {
        std::vector<bool> fixed(mesh_.positions.size(), false);
        std::fill(fixed.begin(), fixed.begin() + layout_.vertex_count(), true);
        for (Index e = 0; e < layout_.edge_count(); ++e) {
            if (layout_.face(2 * e) == kNone || layout_.face(2 * e + 1) == kNone) {
                for (const Index v : mesh_.chains[e]) {
                    fixed[v] = true;
                }
            }
        }
        return fixed;
    }

    QuadMesh finish()
    {
        mesh_.statistics =
            quad_statistics(mesh_.positions, mesh_.quads, surface_normals(target_, mesh_));
        return std::move(mesh_);
    }

private:
    Status choose()
    {
        std::vector<double> lengths;
        for (const std::vector<Index>& chain : refined_.chains) {
            lengths.push_back(chain_length(refined_, chain));
        }
        mesh_.default_edge_length = edge_length_for(base_, layout_, lengths, kDefaultQuads);
        if (!options_.segments_as.empty()) {
            return take_segments();
        }
        const double edge_length =
            options_.edge_length != 0 ? options_.edge_length : mesh_.default_edge_length;
        auto segments = choose_segments(base_, layout_, lengths, edge_length, options_.segments);
        if (!segments) {
            return segments.error();
        }
        segments_ = std::move(*segments);
        return confirm_size();
    }

    /// Takes the numbers of another mesh over.
    Status take_segments()
    {
        segments_ = options_.segments_as;
        bool fit = segments_.size() == base_.edge_count();
        std::vector<Index> of_loops(base_.loop_count(), 0);
        for (Index e = 0; fit && e < base_.edge_count(); ++e) {
            Index& of_loop = of_loops[base_.loops()[e]];
            of_loop = of_loop == 0 ? segments_[e] : of_loop;
            fit = segments_[e] > 0 && segments_[e] == of_loop;
        }
        return fit ? confirm_size()
                   : make_error(ErrorCode::invalidOption,
                                "the numbers of segments are not those of a quad mesh of this "
                                "layout");
    }

    Status confirm_size() const
    {
        double vertices = layout_.vertex_count();
        for (const BaseComplex::Quad& quad : base_.quads()) {
            vertices += (segments_[quad.sides[0].edge] + 1.0) * (segments_[quad.sides[1].edge] + 1);
        }
        if (vertices > kMostVertices) {
            return make_error(ErrorCode::tooLarge,
                              "the quads would have about " +
                                  std::to_string(static_cast<std::int64_t>(vertices)) +
                                  " vertices, more than 16 million");
        }
        return {};
    }

    Index add_vertex(const SurfacePoint& point)
    {
        mesh_.points.push_back(point);
        mesh_.positions.push_back(position_of(target_, point));
        return static_cast<Index>(mesh_.positions.size() - 1);
    }

    /// A triangle beside every chain edge.
    void find_chain_triangles()
    {
        for (const std::vector<Index>& chain : refined_.chains) {
            for (std::size_t i = 1; i < chain.size(); ++i) {
                chain_triangles_[std::minmax(chain[i - 1], chain[i])] = kNone;
            }
        }
        for (Index h = 0; h < refined_.corners.size(); ++h) {
            const Index a = refined_.corners[h];
            const Index b = refined_.corners[TriangleMesh::next(h)];
            const auto found = chain_triangles_.find(std::minmax(a, b));
            if (found != chain_triangles_.end() && found->second == kNone) {
                found->second = h / 3;
            }
        }
    }

    /// The point of a refined edge.
    SurfacePoint on_edge(Index a, Index b, double share) const
    {
        const Index triangle = chain_triangles_.at(std::minmax(a, b));
        std::array<double, 3> weights{0, 0, 0};
        for (std::size_t i = 0; i < 3; ++i) {
            const Index corner = refined_.corners[3 * std::size_t{triangle} + i];
            weights[i] = corner == a ? 1 - share : corner == b ? share : 0;
        }
        return origin_.in_triangle(triangle, weights);
    }

    void place_landmarks()
    {
        mesh_.points.resize(layout_.vertex_count());
        mesh_.positions.resize(layout_.vertex_count());
        for (Index e = 0; e < layout_.edge_count(); ++e) {
            const std::vector<Index>& chain = refined_.chains[e];
            const Index a = layout_.tail(2 * e);
            const Index b = layout_.head(2 * e);
            mesh_.points[a] = on_edge(chain[0], chain[1], 0);
            mesh_.points[b] = on_edge(chain[chain.size() - 2], chain.back(), 1);
            mesh_.positions[a] = refined_.positions[chain.front()];
            mesh_.positions[b] = refined_.positions[chain.back()];
        }
    }

    /// Points on a chain, at the given shares of its length, increasing.
    void place_on_chain(const std::vector<Index>& chain, const std::vector<double>& shares,
                        std::vector<Index>& vertices)
    {
        const double length = chain_length(refined_, chain);
        std::size_t i = 1;
        double begin = 0;
        for (const double share : shares) {
            const double wanted = share * length;
            double step = 0;
            for (;; ++i) {
                step = (refined_.positions[chain[i]] - refined_.positions[chain[i - 1]]).norm();
                if (begin + step >= wanted || i + 1 == chain.size()) {
                    break;
                }
                begin += step;
            }
            const double local = step > 0 ? std::clamp((wanted - begin) / step, 0.0, 1.0) : 0.5;
            vertices.push_back(add_vertex(on_edge(chain[i - 1], chain[i], local)));
        }
    }

    void place_chains()
    {
        edge_vertices_.resize(base_.edge_count());
        for (Index e = 0; e < layout_.edge_count(); ++e) {
            const auto [first, second] = base_.edges_of(e);
            std::vector<double> shares;
            const bool halved = base_.is_subdivided();
            const Index n = segments_[first];
            for (Index i = 1; i < n + (halved ? 1 : 0); ++i) {
                shares.push_back(double(i) / n / (halved ? 2 : 1));
            }
            for (Index i = 1; halved && i < segments_[second]; ++i) {
                shares.push_back(0.5 + double(i) / segments_[second] / 2);
            }
            std::vector<Index> vertices{layout_.tail(2 * e)};
            place_on_chain(refined_.chains[e], shares, vertices);
            vertices.push_back(layout_.head(2 * e));
            if (halved) {
                edge_vertices_[first].assign(vertices.begin(), vertices.begin() + n + 1);
                edge_vertices_[second].assign(vertices.rbegin(),
                                              vertices.rbegin() + segments_[second] + 1);
            } else {
                edge_vertices_[first] = vertices;
            }
            mesh_.chains.push_back(std::move(vertices));
        }
    }

    /// The grids of one patch.
    Status fill(const Patch& patch)
    {
        const Index sides = patch.side_count();
        const Domain domain =
            sides == 4 ? fitting_rectangle(patch, refined_.positions) : regular_polygon(sides);
        const auto map = parametrise(patch, refined_.positions, domain);
        if (!map) {
            return map.error();
        }
        const PointLocation location(*map);
        const auto lift = [&](const PlanePoint& point) {
            const PointLocation::Place place = location.find(point);
            return add_vertex(on_surface(patch, *map, place));
        };
        PlanePoint centre(0, 0);
        for (const PlanePoint& corner : domain) {
            centre += corner / sides;
        }
        const auto corner = [&](Index i) -> const PlanePoint& { return domain[i % sides]; };
        const auto middle = [&](Index i) -> PlanePoint { return (corner(i) + corner(i + 1)) / 2; };
        if (!base_.is_subdivided()) {
            fill_quad(base_.quads()[patch.face], {domain[0], domain[1], domain[2], domain[3]},
                      lift);
            return {};
        }
        const Index centre_vertex = lift(centre);
        for (Index i = 0; i < sides; ++i) {
            // From the middle of the side to the centre.
            const Index spoke = first_spoke_ + i;
            const Index halfedge = layout_.face_halfedges(patch.face)[i];
            std::vector<Index>& vertices = edge_vertices_[spoke];
            vertices.push_back(edge_vertices_[halfedge].back());
            for (Index k = 1; k < segments_[spoke]; ++k) {
                const double share = double(k) / segments_[spoke];
                vertices.push_back(lift((1 - share) * middle(i) + share * centre));
            }
            vertices.push_back(centre_vertex);
        }
        for (Index i = 0; i < sides; ++i) {
            fill_quad(base_.quads()[first_spoke_ - 2 * layout_.edge_count() + i],
                      {corner(i), middle(i), centre, middle(i + sides - 1)}, lift);
        }
        first_spoke_ += sides;
        return {};
    }

    /// From a triangle of the map to the target.
    SurfacePoint on_surface(const Patch& patch, const Parametrisation& map,
                            const PointLocation::Place& place) const
    {
        const auto weights = map.weights_in_parent(patch, place.triangle, place.barycentrics);
        return origin_.in_triangle(patch.triangles[map.parents[place.triangle]], weights);
    }

    template <typename Lift>
    void fill_quad(const BaseComplex::Quad& quad, const std::array<PlanePoint, 4>& corners,
                   const Lift& lift)
    {
        std::array<std::vector<Index>, 4> rims;
        for (std::size_t i = 0; i < 4; ++i) {
            rims[i] = edge_vertices_[quad.sides[i].edge];
            if (quad.sides[i].backwards) {
                std::reverse(rims[i].begin(), rims[i].end());
            }
        }
        const auto m = static_cast<Index>(rims[0].size() - 1);
        const auto n = static_cast<Index>(rims[1].size() - 1);
        std::vector<Index> grid(std::size_t{m + 1} * (n + 1));
        const auto at = [&](Index i, Index j) -> Index& {
            return grid[std::size_t{j} * (m + 1) + i];
        };
        for (Index i = 0; i <= m; ++i) {
            at(i, 0) = rims[0][i];
            at(i, n) = rims[2][m - i];
        }
        for (Index j = 0; j <= n; ++j) {
            at(m, j) = rims[1][j];
            at(0, j) = rims[3][n - j];
        }
        for (Index j = 1; j < n; ++j) {
            for (Index i = 1; i < m; ++i) {
                const double s = double(i) / m;
                const double t = double(j) / n;
                at(i, j) = lift((1 - t) * ((1 - s) * corners[0] + s * corners[1]) +
                                t * ((1 - s) * corners[3] + s * corners[2]));
            }
        }
        for (Index j = 0; j < n; ++j) {
            for (Index i = 0; i < m; ++i) {
                mesh_.quads.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
                mesh_.quad_faces.push_back(quad.face);
            }
        }
    }

    void describe()
    {
        mesh_.is_subdivided = base_.is_subdivided();
        mesh_.segments = segments_;
        for (Index e = 0; e < layout_.edge_count(); ++e) {
            const auto [first, second] = base_.edges_of(e);
            mesh_.loops.push_back({base_.loops()[first], base_.loops()[second]});
        }
        for (Index e = base_.is_subdivided() ? 2 * layout_.edge_count() : base_.edge_count();
             e < base_.edge_count(); ++e) {
            mesh_.chains.push_back(edge_vertices_[e]);
        }
    }

    const Layout& layout_;
    const TriangleMesh& target_;
    const RefinedMesh& refined_;
    QuadOptions options_;
    BaseComplex base_;
    RefinedOrigin origin_;
    std::vector<Index> segments_;                               // per base edge
    std::map<std::pair<Index, Index>, Index> chain_triangles_;  // by refined edge
    std::vector<std::vector<Index>> edge_vertices_;             // per base edge
    Index first_spoke_ = 0;
    QuadMesh mesh_;
};

struct QuadMeshJob::Implementation {
    Implementation(const Layout& layout, const TriangleMesh& surface, const RefinedMesh& refined,
                   const QuadOptions& options)
        : target(surface),
          rounds(options.relaxation_rounds),
          mesher(layout, surface, refined, options)
    {}

    const TriangleMesh& target;
    Index rounds;
    Mesher mesher;
    std::optional<QuadRelaxation> relaxation;
    Status status;
    bool is_over = false;
};

QuadMeshJob::QuadMeshJob(const Layout& layout, const TriangleMesh& target,
                         const RefinedMesh& refined, const QuadOptions& options)
    : implementation_(std::make_unique<Implementation>(layout, target, refined, options))
{}
QuadMeshJob::~QuadMeshJob() = default;

bool QuadMeshJob::step()
{
    Implementation& job = *implementation_;
    if (job.is_over) {
        return false;
    }
    if (!job.relaxation) {
        job.status = job.mesher.fill();
        job.is_over = !job.status;
        if (job.status) {
            job.relaxation.emplace(job.target, job.mesher.fixed_vertices(), job.rounds,
                                   job.mesher.mesh());
        }
    } else {
        job.is_over = !job.relaxation->step();
    }
    return !job.is_over;
}

double QuadMeshJob::progress() const
{
    const Implementation& job = *implementation_;
    return job.is_over ? 1 : job.relaxation ? job.relaxation->progress() : 0;
}

Result<QuadMesh> QuadMeshJob::take()
{
    Implementation& job = *implementation_;
    if (!job.relaxation) {
        step();
    }
    if (!job.status) {
        return job.status.error();
    }
    return job.mesher.finish();
}

Result<QuadMesh> make_quad_mesh(const Layout& layout, const TriangleMesh& target,
                                const RefinedMesh& refined, const QuadOptions& options)
{
    QuadMeshJob job(layout, target, refined, options);
    while (job.step()) {
    }
    return job.take();
}

std::string write_quad_obj(const QuadMesh& mesh)
{
    PolygonMesh polygons;
    polygons.positions = mesh.positions;
    for (const auto& quad : mesh.quads) {
        polygons.add_face(quad);
    }
    return write_obj(polygons, {mesh.quad_faces, "patch_", mesh.chains});
}

}  // namespace layout_embedding
