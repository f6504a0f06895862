#include "embedding/angle_refinement.hh"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <queue>
#include <utility>
#include <vector>

#include "embedding/refined_origin.hh"
#include "embedding/wanted_angles.hh"
#include "mesh/surface_point.hh"

namespace layout_embedding {

namespace {

/// Off-centers are placed for angles larger than the wanted ones by this factor.
constexpr double kAmbition = 1.3;
constexpr double kAngleRounding = 1e-9;
constexpr int kMostSteps = 200;
constexpr int kMostDivisions = 5;
/// Vertices that may be added for each one that the cut added.
constexpr double kMostShare = 1;

struct Corner {
    double dot;    // of the two sides
    double cross;  // of them, its length

    /// Infinite for right and larger angles.
    double tangent() const
    {
        return dot > 0 ? cross / dot : std::numeric_limits<double>::infinity();
    }
};

Corner corner_at(const Vec3& a, const Vec3& b, const Vec3& c)
{
    const Vec3 u = b - a;
    const Vec3 v = c - a;
    return {u.dot(v), u.cross(v).norm()};
}

class AngleRefinement {
public:
    AngleRefinement(const TriangleMesh& target, RefinedMesh& refined)
        : target_(target),
          refined_(refined),
          origin_(target, refined),
          wanted_(target),
          cut_vertices_(static_cast<Index>(refined.positions.size()))
    {}

    Index run()
    {
        connect();
        const std::size_t before = refined_.positions.size();
        const std::size_t most =
            before + static_cast<std::size_t>(kMostShare *
                                              static_cast<double>(refined_.vertex_faces.size()));
        for (Index t = 0; t < triangle_count(); ++t) {
            push(t);
        }
        while (!queue_.empty() && refined_.positions.size() < most) {
            const Entry entry = queue_.top();
            queue_.pop();
            if (entry.version != versions_[entry.triangle]) {
                continue;
            }
            const std::size_t count = refined_.positions.size();
            improve(entry.triangle, entry.corner);
            // An edge in the way may have been far away.
            if (entry.version == versions_[entry.triangle] && refined_.positions.size() > count) {
                push(entry.triangle);
            }
        }
        extend_chains();
        return static_cast<Index>(refined_.positions.size() - before);
    }

private:
    struct Entry {
        double badness;
        Index triangle;
        Index corner;
        Index version;

        friend bool operator<(const Entry& a, const Entry& b)
        {
            return a.badness != b.badness ? a.badness < b.badness : a.triangle > b.triangle;
        }
    };

    Index triangle_count() const { return static_cast<Index>(refined_.triangle_faces.size()); }
    Index tail(Index h) const { return refined_.corners[h]; }
    Index head(Index h) const { return refined_.corners[TriangleMesh::next(h)]; }
    const Vec3& position(Index h) const { return refined_.positions[tail(h)]; }

    void connect()
    {
        std::vector<std::pair<Index, Index>> chain_edges;
        for (const std::vector<Index>& chain : refined_.chains) {
            for (std::size_t i = 1; i < chain.size(); ++i) {
                chain_edges.push_back(std::minmax(chain[i - 1], chain[i]));
            }
        }
        std::sort(chain_edges.begin(), chain_edges.end());
        const Index halfedges = static_cast<Index>(refined_.corners.size());
        struct Side {
            std::pair<Index, Index> ends;
            Index halfedge;
        };
        std::vector<Side> sides(halfedges);
        for (Index h = 0; h < halfedges; ++h) {
            sides[h] = {std::minmax(tail(h), head(h)), h};
        }
        std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
            return a.ends != b.ends ? a.ends < b.ends : a.halfedge < b.halfedge;
        });
        opposites_.assign(halfedges, kNone);
        fixed_.assign(halfedges, true);
        auto chain_edge = chain_edges.begin();
        for (std::size_t i = 0; i + 1 < sides.size(); ++i) {
            if (sides[i].ends != sides[i + 1].ends) {
                continue;
            }
            while (chain_edge != chain_edges.end() && *chain_edge < sides[i].ends) {
                ++chain_edge;
            }
            const bool on_chain = chain_edge != chain_edges.end() && *chain_edge == sides[i].ends;
            const Index h = sides[i].halfedge;
            const Index g = sides[i + 1].halfedge;
            link(h, g,
                 on_chain || refined_.triangle_faces[h / 3] != refined_.triangle_faces[g / 3]);
        }
        versions_.assign(triangle_count(), 0);
    }

    /// Queues a triangle that is too thin; the whole faces of the target are not.
    void push(Index t)
    {
        ++versions_[t];
        const Index h = 3 * t;
        if (tail(h) < target_.vertex_count() && tail(h + 1) < target_.vertex_count() &&
            tail(h + 2) < target_.vertex_count()) {
            return;
        }
        double least = std::numeric_limits<double>::infinity();
        Index place = kNone;
        for (Index i = 0; i < 3; ++i) {
            if (fixed_[h + i] && fixed_[h + (i + 2) % 3]) {
                continue;
            }
            const double tangent =
                corner_at(position(h + i), position(h + (i + 1) % 3), position(h + (i + 2) % 3))
                    .tangent();
            if (tangent < least) {
                least = tangent;
                place = h + i;
            }
        }
        const double wanted = place == kNone ? 0 : wanted_.tangent_in(refined_.triangle_faces[t]);
        if (least < wanted * (1 - kAngleRounding)) {
            queue_.push({wanted / least, t, place, versions_[t]});
        }
    }

    /// Adds a vertex for the too small angle at the tail of `corner`.
    void improve(Index t, Index corner)
    {
        const Index base = TriangleMesh::next(corner);
        const Vec3& apex = position(corner);
        const Vec3& a = position(base);
        const Vec3& b = position(TriangleMesh::next(base));
        const Index face = refined_.triangle_faces[t];
        const Vec3 normal = face_normal(target_, face);
        const Vec3 side = b - a;
        const Corner angle = corner_at(apex, a, b);
        if (!(angle.cross > 0)) {
            return;
        }
        // Above the base: the circumcenter, and the point that sees the base under a large enough
        // angle.
        const double wanted = kAmbition * wanted_.tangent_in(face);
        const double height = std::min(0.5 * angle.dot / angle.cross,
                                       0.5 * (1 + std::sqrt(1 + wanted * wanted)) / wanted);
        const Vec3 place = 0.5 * (a + b) + height * normal.cross(side);
        Index here = t;
        for (int step = 0; step < kMostSteps; ++step) {
            Index out = kNone;
            double least = 0;
            std::array<double, 3> areas{};
            double whole = 0;
            for (Index i = 0; i < 3; ++i) {
                const Index h = 3 * here + i;
                const Vec3& from = position(h);
                const Vec3& to = position(TriangleMesh::next(h));
                const double area = normal.dot((to - from).cross(place - from));
                areas[(i + 2) % 3] = area;
                whole += area;
                if (area < least) {
                    least = area;
                    out = h;
                }
            }
            if (out == kNone) {
                insert(here, place, areas, whole);
                return;
            }
            if (fixed_[out]) {
                split_fixed(out);
                return;
            }
            here = opposites_[out] / 3;
        }
    }

    void insert(Index t, const Vec3& place, std::array<double, 3> areas, double whole)
    {
        Index nearest = kNone;
        for (Index i = 0; i < 3; ++i) {
            const Index h = 3 * t + i;
            const Vec3& from = position(h);
            const Vec3& to = position(TriangleMesh::next(h));
            const bool in_the_way = fixed_[h] && (from - place).dot(to - place) < 0;
            if (in_the_way) {
                split_fixed(h);
                return;
            }
            if (!fixed_[h] && areas[(i + 2) % 3] < 0.01 * whole) {
                nearest = h;
            }
        }
        if (nearest != kNone) {
            const Vec3& from = position(nearest);
            const Vec3 along = position(TriangleMesh::next(nearest)) - from;
            const double share = along.dot(place - from) / along.squaredNorm();
            split(nearest, std::clamp(share, 0.05, 0.95));
            return;
        }
        for (double& area : areas) {
            area /= whole;
        }
        const Index m = add_vertex(origin_.in_triangle(t, areas));
        const Index a = tail(3 * t);
        const Index b = tail(3 * t + 1);
        const Index c = tail(3 * t + 2);
        const std::array<Outer, 3> outer{outside(3 * t), outside(3 * t + 1), outside(3 * t + 2)};
        const Index u = add_triangle(t);
        const Index v = add_triangle(t);
        set_triangle(t, a, b, m);
        set_triangle(u, b, c, m);
        set_triangle(v, c, a, m);
        link(3 * t + 1, 3 * u + 2, false);
        link(3 * u + 1, 3 * v + 2, false);
        link(3 * v + 1, 3 * t + 2, false);
        link(3 * t, outer[0]);
        link(3 * u, outer[1]);
        link(3 * v, outer[2]);
        settle({3 * t, 3 * u, 3 * v}, {t, u, v});
    }

    /// Near its middle; from a vertex of the cut mesh at a distance that is a power of two, so that
    /// edges at a small angle are divided at the same distances. Those much smaller than what the
    /// cut made of them stay.
    void split_fixed(Index h)
    {
        const auto found = depths_.find(std::minmax(tail(h), head(h)));
        if (found != depths_.end() && found->second >= kMostDivisions) {
            return;
        }
        const double length = (position(TriangleMesh::next(h)) - position(h)).norm();
        const bool from_tail = tail(h) < cut_vertices_;
        if (from_tail == (head(h) < cut_vertices_)) {
            split(h, 0.5);
        } else {
            int exponent = 0;
            std::frexp(length * (2.0 / 3.0), &exponent);
            const double share = std::ldexp(0.5, exponent) / length;
            split(h, from_tail ? share : 1 - share);
        }
    }

    /// Puts a vertex on an edge, at `share` of the way along the halfedge.
    void split(Index h, double share)
    {
        const Index t = h / 3;
        const Index g = opposites_[h];
        const bool fixed = fixed_[h];
        const Index a = tail(h);
        const Index b = head(h);
        std::array<double, 3> weights{};
        weights[h % 3] = 1 - share;
        weights[TriangleMesh::next(h) % 3] = share;
        SurfacePoint point = origin_.in_triangle(t, weights);
        for (Index i = 0; i < 3; ++i) {
            // On an edge of the target: in the face that gives it its direction, as crossings are.
            const Index side = 3 * point.face + i;
            if (point.barycentrics[(i + 2) % 3] == 0) {
                const Index face = TriangleMesh::face_of(target_.halfedge(target_.edge(side)));
                point = {face, coordinates_in_face(target_, point, face)};
                break;
            }
        }
        const Index m = add_vertex(point);
        if (fixed) {
            splits_[std::minmax(a, b)] = m;
            const auto found = depths_.find(std::minmax(a, b));
            const int depth = found == depths_.end() ? 1 : found->second + 1;
            depths_[std::minmax(a, m)] = depths_[std::minmax(m, b)] = depth;
        }
        std::vector<Index> rim;
        std::vector<Index> changed;
        const Index t2 = halve(h, m, rim, changed);
        if (g == kNone) {
            opposites_[h] = opposites_[t2] = kNone;
            fixed_[h] = fixed_[t2] = true;
        } else {
            const Index u2 = halve(g, m, rim, changed);
            link(h, u2, fixed);
            link(t2, g, fixed);
        }
        settle(rim, changed);
    }

    /// Divides the triangle (a, b, c) of a halfedge from a to b into (a, m, c) with the same
    /// halfedge from a to m, and a new one (m, b, c); returns the halfedge from m to b.
    Index halve(Index h, Index m, std::vector<Index>& rim, std::vector<Index>& changed)
    {
        const Index t = h / 3;
        const Index n = TriangleMesh::next(h);
        const Index p = TriangleMesh::previous(h);
        const Index b = tail(n);
        const Index c = tail(p);
        const Outer beyond = outside(n);
        const Index u = add_triangle(t);
        refined_.corners[n] = m;
        set_triangle(u, m, b, c);
        link(n, 3 * u + 2, false);
        link(3 * u + 1, beyond);
        rim.push_back(p);
        rim.push_back(3 * u + 1);
        changed.push_back(t);
        changed.push_back(u);
        return 3 * u;
    }

    /// Flips edges until those that are free to do so are Delaunay; `rim` are the edges opposite to
    /// a new vertex.
    void settle(std::vector<Index> rim, std::vector<Index> changed)
    {
        while (!rim.empty()) {
            const Index h = rim.back();
            rim.pop_back();
            if (fixed_[h] || is_delaunay(h)) {
                continue;
            }
            const Index g = opposites_[h];
            flip(h);
            // The new vertex is the apex of h's triangle; those beyond are g's next two.
            changed.push_back(h / 3);
            changed.push_back(g / 3);
            rim.push_back(flipped_rim_[0]);
            rim.push_back(flipped_rim_[1]);
        }
        std::sort(changed.begin(), changed.end());
        changed.erase(std::unique(changed.begin(), changed.end()), changed.end());
        for (const Index t : changed) {
            push(t);
        }
    }

    bool is_delaunay(Index h) const
    {
        const Index g = opposites_[h];
        const Index c = TriangleMesh::previous(h);
        const Index d = TriangleMesh::previous(g);
        const Corner left = corner_at(position(c), position(h), position(g));
        const Corner right = corner_at(position(d), position(g), position(h));
        const double sum = left.dot * right.cross + right.dot * left.cross;
        const double size = (std::abs(left.dot) + left.cross) * (std::abs(right.dot) + right.cross);
        return sum >= -kAngleRounding * size;
    }

    /// The edge from a to b, with the apexes c of h and d beyond, becomes one from d to c.
    void flip(Index h)
    {
        const Index g = opposites_[h];
        const Index t = h / 3;
        const Index u = g / 3;
        const Index a = tail(h);
        const Index b = tail(g);
        const Index c = tail(TriangleMesh::previous(h));
        const Index d = tail(TriangleMesh::previous(g));
        const Outer bc = outside(TriangleMesh::next(h));
        const Outer ca = outside(TriangleMesh::previous(h));
        const Outer ad = outside(TriangleMesh::next(g));
        const Outer db = outside(TriangleMesh::previous(g));
        set_triangle(t, a, d, c);
        set_triangle(u, d, b, c);
        link(3 * t + 1, 3 * u + 2, false);
        link(3 * t, ad);
        link(3 * t + 2, ca);
        link(3 * u, db);
        link(3 * u + 1, bc);
        flipped_rim_ = {3 * t, 3 * u};
    }

    /// What lies beyond a halfedge, while its triangle is made anew.
    struct Outer {
        Index opposite;
        bool fixed;
    };
    Outer outside(Index h) const { return {opposites_[h], fixed_[h]}; }

    void link(Index h, const Outer& outer) { link(h, outer.opposite, outer.fixed); }
    void link(Index h, Index g, bool fixed)
    {
        opposites_[h] = g;
        fixed_[h] = fixed;
        if (g != kNone) {
            opposites_[g] = h;
            fixed_[g] = fixed;
        }
    }

    void set_triangle(Index t, Index a, Index b, Index c)
    {
        refined_.corners[3 * t] = a;
        refined_.corners[3 * t + 1] = b;
        refined_.corners[3 * t + 2] = c;
    }

    /// A new triangle in the face and patch of another one.
    Index add_triangle(Index like)
    {
        refined_.corners.resize(refined_.corners.size() + 3);
        refined_.triangle_faces.push_back(refined_.triangle_faces[like]);
        refined_.triangle_patches.push_back(refined_.triangle_patches[like]);
        opposites_.resize(opposites_.size() + 3, kNone);
        fixed_.resize(fixed_.size() + 3, false);
        versions_.push_back(0);
        return triangle_count() - 1;
    }

    Index add_vertex(const SurfacePoint& point)
    {
        refined_.positions.push_back(position_of(target_, point));
        refined_.vertex_faces.push_back(point.face);
        refined_.vertex_barycentrics.push_back(point.barycentrics);
        return static_cast<Index>(refined_.positions.size() - 1);
    }

    void extend_chains()
    {
        for (std::vector<Index>& chain : refined_.chains) {
            std::vector<Index> whole{chain.front()};
            for (std::size_t i = 1; i < chain.size(); ++i) {
                append_split(chain[i - 1], chain[i], whole);
            }
            chain = std::move(whole);
        }
    }

    void append_split(Index from, Index to, std::vector<Index>& chain) const
    {
        if (const auto found = splits_.find(std::minmax(from, to)); found != splits_.end()) {
            append_split(from, found->second, chain);
            append_split(found->second, to, chain);
        } else {
            chain.push_back(to);
        }
    }

    const TriangleMesh& target_;
    RefinedMesh& refined_;
    RefinedOrigin origin_;
    WantedAngles wanted_;
    std::vector<Index> opposites_;  // per halfedge, kNone on the boundary
    std::vector<bool> fixed_;       // per halfedge: on an edge of the target or a chain
    std::vector<Index> versions_;   // per triangle: entries of others are out of date
    std::priority_queue<Entry> queue_;
    std::map<std::pair<Index, Index>, Index> splits_;  // of edges that stay, by their ends
    std::map<std::pair<Index, Index>, int> depths_;    // how often they were divided
    std::array<Index, 2> flipped_rim_{};
    Index cut_vertices_;
};

}  // namespace

Index refine_thin_triangles(const TriangleMesh& target, RefinedMesh& refined)
{
    return AngleRefinement(target, refined).run();
}

}  // namespace layout_embedding
