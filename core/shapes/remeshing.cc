#include "shapes/remeshing.hh"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/random.hh"

namespace layout_embedding::shapes {

namespace {

/// Cosines of the largest and of the smallest angle of a triangle, in this order.
std::array<double, 2> angle_cosines(const Vec3& a, const Vec3& b, const Vec3& c)
{
    const double ab = (b - a).squaredNorm();
    const double bc = (c - b).squaredNorm();
    const double ca = (a - c).squaredNorm();
    const auto cosine = [](double x, double y, double across) {
        const double product = 4.0 * x * y;
        return product > 0.0 ? (x + y - across) / std::sqrt(product) : 1.0;
    };
    const std::array<double, 3> cosines{cosine(ab, ca, bc), cosine(ab, bc, ca), cosine(bc, ca, ab)};
    return {*std::min_element(cosines.begin(), cosines.end()),
            *std::max_element(cosines.begin(), cosines.end())};
}

/// The point of a triangle that is closest to p.
Vec3 closest_point(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& p)
{
    const Vec3 normal = (b - a).cross(c - a);
    const auto outside = [&](const Vec3& from, const Vec3& to) {
        return normal.cross(to - from).dot(p - from) < 0.0;
    };
    if (normal.squaredNorm() > 0.0 && !outside(a, b) && !outside(b, c) && !outside(c, a)) {
        return p - normal * (normal.dot(p - a) / normal.squaredNorm());
    }
    Vec3 best = a;
    for (const auto& [from, to] : {std::pair{a, b}, std::pair{b, c}, std::pair{c, a}}) {
        const double length = (to - from).squaredNorm();
        const double t =
            length > 0.0 ? std::clamp((p - from).dot(to - from) / length, 0.0, 1.0) : 0.0;
        const Vec3 q = from + t * (to - from);
        if ((q - p).squaredNorm() < (best - p).squaredNorm()) {
            best = q;
        }
    }
    return best;
}

class Remesher {
public:
    Remesher(const Solid& solid, const RawSurface& surface, const std::optional<CutPlane>& cut,
             const RemeshOptions& options)
        : solid_(solid),
          cut_(cut),
          options_(options),
          random_(options.seed),
          mesh_(surface.positions, surface.corners),
          locked_(mesh_.vertex_count(), false)
    {
        normals_.resize(mesh_.vertex_count());
        for (Index v = 0; v < mesh_.vertex_count(); ++v) {
            normals_[v] = solid_.value(position(v)).normal;
        }
    }

    void run(const std::vector<Anchor>& anchors)
    {
        const double surplus = 1.0 + 0.9 * options_.irregularity;
        const double wanted = surplus * options_.vertices;
        find_sizes(wanted);
        // The grid left many more vertices than are wanted, and slivers that would turn over if
        // their vertices were moved.
        collapse_short_edges(false);
        collapse_short_edges(false);
        compact();
        for (Index v = 0; v < mesh_.vertex_count(); ++v) {
            settle(v);
        }
        for (int i = 0; i < 3; ++i) {
            iterate();
            compact();
        }
        for (const Anchor& anchor : anchors) {
            anchors_.push_back(insert(anchor));
        }
        for (int i = 0; i < 4; ++i) {
            const double ratio = std::sqrt(mesh_.live_vertex_count() / wanted);
            const double factor = std::clamp(ratio, 0.6, 1.6);
            for (double& size : sizes_) {
                size *= factor;
            }
            iterate();
        }
        roughen();
        simplify();
        make_delaunay();
        for (int i = 0; i < 30 && mend(); ++i) {
        }
    }

    /// Forgets what was removed.
    void compact()
    {
        const std::vector<Index> map = mesh_.compact();
        for (Index v = 0; v < map.size(); ++v) {
            if (map[v] != kNone) {
                normals_[map[v]] = normals_[v];
                sizes_[map[v]] = sizes_[v];
                locked_[map[v]] = locked_[v];
            }
        }
        normals_.resize(mesh_.vertex_count());
        sizes_.resize(mesh_.vertex_count());
        locked_.resize(mesh_.vertex_count());
    }

    Remeshed result()
    {
        const std::vector<Index> map = mesh_.compact();
        for (Index& anchor : anchors_) {
            anchor = map[anchor];
        }
        return {std::move(mesh_), std::move(anchors_)};
    }

private:
    const Vec3& position(Index v) const { return mesh_.positions[v]; }
    double length(Index h) const
    {
        return (position(mesh_.head(h)) - position(mesh_.tail(h))).norm();
    }
    double wanted_length(Index h) const
    {
        return 0.5 * (sizes_[mesh_.head(h)] + sizes_[mesh_.tail(h)]);
    }
    bool first_of_edge(Index h) const
    {
        return mesh_.has_halfedge(h) && (mesh_.opposite(h) == kNone || h < mesh_.opposite(h));
    }
    bool on_boundary(Index h) const { return mesh_.opposite(h) == kNone; }

    /// Puts v onto the surface, and onto the cut plane if it lies on the boundary.
    void settle(Index v)
    {
        Vec3& p = mesh_.positions[v];
        const bool rim = mesh_.is_boundary(v);
        for (int i = 0; i < 5; ++i) {
            if (rim) {
                p -= (p - cut_->origin).dot(cut_->normal) * cut_->normal;
            }
            const Solid::Value value = solid_.value(p);
            normals_[v] = value.normal;
            Vec3 direction = value.normal;
            if (rim) {
                direction -= direction.dot(cut_->normal) * cut_->normal;
                const double slope = direction.squaredNorm();
                direction = slope > 0.01 ? Vec3(direction / slope) : Vec3(Vec3::Zero());
            }
            // Far away a step must not be trusted.
            p -= std::clamp(value.distance, -options_.cell, options_.cell) * direction;
            if (std::abs(value.distance) < 0.05 * options_.cell) {
                break;
            }
        }
    }

    /// Edge lengths that follow the radius of curvature, within limits, change slowly, and make
    /// about `wanted` vertices.
    void find_sizes(double wanted)
    {
        const Index count = mesh_.vertex_count();
        std::vector<double> bends(count, 0.0);
        std::vector<double> areas(count, 0.0);
        for (Index v = 0; v < count; ++v) {
            mesh_.for_neighbors(v, [&](Index w) {
                const double distance = (position(w) - position(v)).norm();
                if (distance > 0.4 * options_.cell) {
                    bends[v] = std::max(bends[v], (normals_[w] - normals_[v]).norm() / distance);
                }
            });
        }
        for (int round = 0; round < 2; ++round) {
            std::vector<double> smoothed = bends;
            for (Index v = 0; v < count; ++v) {
                double sum = 2.0 * bends[v];
                double weight = 2.0;
                mesh_.for_neighbors(v, [&](Index w) {
                    sum += bends[w];
                    weight += 1.0;
                });
                smoothed[v] = sum / weight;
            }
            bends = std::move(smoothed);
        }
        double area = 0.0;
        for (Index f = 0; f < mesh_.face_count(); ++f) {
            const auto [a, b, c] = mesh_.face(f);
            const double third =
                (position(b) - position(a)).cross(position(c) - position(a)).norm() / 6.0;
            area += 3.0 * third;
            for (const Index v : {a, b, c}) {
                areas[v] += third;
            }
        }
        // Up to this radius of curvature more of it means longer edges.
        const double widest = 0.35 * std::sqrt(area / 3.0);
        sizes_.resize(count);
        for (Index v = 0; v < count; ++v) {
            const double radius = bends[v] > 0.0 ? 1.0 / bends[v] : widest;
            const double relative = std::clamp(radius / widest, 0.12, 1.0);
            sizes_[v] = widest * (1.0 - options_.adaptivity * (1.0 - relative));
        }
        for (int round = 0; round < 3; ++round) {
            double expected = 0.0;
            for (Index v = 0; v < count; ++v) {
                expected += areas[v] / (sizes_[v] * sizes_[v]);
            }
            // About one vertex per two triangles of the wanted edge length.
            const double factor = std::sqrt(1.1 * expected / wanted);
            for (double& size : sizes_) {
                size *= factor;
            }
            if (round < 2) {
                for (int sweep = 0; sweep < 12; ++sweep) {
                    limit_growth();
                }
            }
        }
    }

    void limit_growth()
    {
        for (Index v = 0; v < mesh_.vertex_count(); ++v) {
            mesh_.for_neighbors(v, [&](Index w) {
                sizes_[v] =
                    std::min(sizes_[v], sizes_[w] + 0.3 * (position(w) - position(v)).norm());
            });
        }
    }

    void iterate()
    {
        split_long_edges();
        collapse_short_edges(true);
        make_delaunay();
        make_delaunay();
        relax();
    }

    void add_vertex_data(double size, const Vec3& normal)
    {
        sizes_.push_back(size);
        normals_.push_back(normal);
        locked_.push_back(false);
    }

    void split_long_edges()
    {
        const Index count = mesh_.halfedge_count();
        for (Index h = 0; h < count; ++h) {
            if (!first_of_edge(h) || length(h) < 1.35 * wanted_length(h)) {
                continue;
            }
            const Index a = mesh_.tail(h);
            const Index b = mesh_.head(h);
            const double size = wanted_length(h);
            const Index m = mesh_.split_edge(h, 0.5 * (position(a) + position(b)));
            add_vertex_data(size, normals_[a]);
            settle(m);
        }
    }

    /// Whether the normal of a triangle with these vertices, with v at p, and the mean of theirs
    /// have an angle with at least this cosine.
    bool looks_out(Index v, const Vec3& p, Index b, Index c, double least = 0.15) const
    {
        const Vec3 normal = (position(b) - p).cross(position(c) - p);
        const Vec3 out = normals_[v] + normals_[b] + normals_[c];
        return normal.dot(out) > least * normal.norm() * out.norm();
    }

    /// How many faces at v do not look outwards with v at p, other than the (up to two) faces that
    /// also have `except`.
    int inward_faces(Index v, const Vec3& p, Index except = kNone) const
    {
        int count = 0;
        mesh_.for_outgoing(v, [&](Index h) {
            const Index b = mesh_.head(h);
            const Index c = mesh_.apex(h);
            count += b != except && c != except && !looks_out(v, p, b, c) ? 1 : 0;
        });
        return count;
    }

    /// Edges become their midpoints, put onto the surface, if `exact`, else one of their ends.
    void collapse_short_edges(bool exact)
    {
        for (Index h = 0; h < mesh_.halfedge_count(); ++h) {
            if (!mesh_.has_halfedge(h) || length(h) > 0.75 * wanted_length(h)) {
                continue;
            }
            const Index a = mesh_.tail(h);
            const Index b = mesh_.head(h);
            if (locked_[a] || !mesh_.can_collapse(h)) {
                continue;
            }
            const bool b_stays =
                !exact || locked_[b] || mesh_.is_boundary(b) != mesh_.is_boundary(a);
            const Vec3 target = b_stays ? position(b) : Vec3(0.5 * (position(a) + position(b)));
            // Where the surface is folded, less of it is all that can be asked for.
            const int folded = inward_faces(a, target, b) + inward_faces(b, target, a);
            bool good =
                folded == 0 || folded < inward_faces(a, position(a)) + inward_faces(b, position(b));
            mesh_.for_neighbors(a, [&](Index w) {
                const double limit = 0.7 * (sizes_[b] + sizes_[w]);
                good = good && (w == b || (position(w) - target).norm() < limit);
            });
            if (good) {
                mesh_.collapse(h);
                if (!b_stays) {
                    mesh_.positions[b] = target;
                    settle(b);
                }
            }
        }
    }

    /// The sum of the angles opposite to the edge exceeds two right angles.
    bool not_delaunay(Index h) const
    {
        const Index g = mesh_.opposite(h);
        const auto cotangent = [&](Index side) {
            const Vec3 a = position(mesh_.tail(side)) - position(mesh_.apex(side));
            const Vec3 b = position(mesh_.head(side)) - position(mesh_.apex(side));
            return a.dot(b) / std::max(a.cross(b).norm(), 1e-300);
        };
        return cotangent(h) + cotangent(g) < -1e-9;
    }

    bool flip_fits(Index h) const
    {
        const Index g = mesh_.opposite(h);
        const Index a = mesh_.tail(h);
        const Index b = mesh_.head(h);
        const Index c = mesh_.apex(h);
        const Index d = mesh_.apex(g);
        // Stricter than for collapses: flips across a sharp edge notch it.
        const bool one = looks_out(d, position(d), c, a, 0.6);
        const bool other = looks_out(c, position(c), d, b, 0.6);
        if (one && other) {
            return true;
        }
        const bool folded = !looks_out(a, position(a), b, c) && !looks_out(b, position(b), a, d);
        return folded && (one || other);
    }

    void make_delaunay()
    {
        for (Index h = 0; h < mesh_.halfedge_count(); ++h) {
            if (first_of_edge(h) && !on_boundary(h) && not_delaunay(h) && mesh_.can_flip(h) &&
                flip_fits(h)) {
                mesh_.flip(h);
            }
        }
    }

    void relax()
    {
        for (Index v = 0; v < mesh_.vertex_count(); ++v) {
            if (!mesh_.has_vertex(v) || locked_[v]) {
                continue;
            }
            Vec3 center = Vec3::Zero();
            double weight = 0.0;
            if (mesh_.is_boundary(v)) {
                Index last = kNone;
                mesh_.for_neighbors(v, [&](Index w) { last = w; });
                center = position(mesh_.head(mesh_.outgoing(v))) + position(last);
                weight = 2.0;
            } else {
                mesh_.for_outgoing(v, [&](Index h) {
                    const Vec3& b = position(mesh_.head(h));
                    const Vec3& c = position(mesh_.apex(h));
                    const double area = (b - position(v)).cross(c - position(v)).norm();
                    center += area * (position(v) + b + c);
                    weight += 3.0 * area;
                });
            }
            if (!(weight > 0.0)) {
                continue;
            }
            Vec3 move = center / weight - position(v);
            move -= normals_[v].dot(move) * normals_[v];
            try_move(v, position(v) + 0.8 * move);
        }
    }

    /// Moves v to the surface near p, unless that turns faces over.
    void try_move(Index v, const Vec3& p)
    {
        const Vec3 old_position = position(v);
        const Vec3 old_normal = normals_[v];
        const int folded = inward_faces(v, old_position);
        mesh_.positions[v] = p;
        settle(v);
        if (inward_faces(v, position(v)) > folded) {
            mesh_.positions[v] = old_position;
            normals_[v] = old_normal;
        }
    }

    Index insert(const Anchor& anchor)
    {
        double best = std::numeric_limits<double>::infinity();
        Index place = kNone;
        const Vec3 normal = solid_.value(anchor.position).normal;
        for (Index f = 0; f < mesh_.face_count(); ++f) {
            if (!mesh_.has_face(f)) {
                continue;
            }
            for (Index h = 3 * f; h < 3 * f + (anchor.on_boundary ? 3U : 1U); ++h) {
                if (anchor.on_boundary && !on_boundary(h)) {
                    continue;
                }
                const Vec3& a = position(mesh_.tail(h));
                const Vec3& b = position(mesh_.head(h));
                const Vec3& c = anchor.on_boundary ? b : position(mesh_.apex(h));
                const double distance =
                    (closest_point(a, b, c, anchor.position) - anchor.position).norm();
                // On thin parts the other side may be nearer.
                const double agreement = normals_[mesh_.tail(h)].dot(normal);
                const double score = distance + (agreement < 0.2 ? options_.cell : 0.0);
                if (score < best) {
                    best = score;
                    place = h;
                }
            }
        }
        const double size = sizes_[mesh_.tail(place)];
        const Index v = anchor.on_boundary ? mesh_.split_edge(place, anchor.position)
                                           : mesh_.split_face(place / 3, anchor.position);
        add_vertex_data(size, normal);
        locked_[v] = true;
        return v;
    }

    /// Moves vertices at random within their surroundings.
    void roughen()
    {
        for (Index v = 0; v < mesh_.vertex_count(); ++v) {
            const double x = random_.unit() - 0.5;
            const double y = random_.unit() - 0.5;
            const double z = random_.unit() - 0.5;
            if (!mesh_.has_vertex(v) || locked_[v] || mesh_.is_boundary(v)) {
                continue;
            }
            Vec3 move = 0.7 * options_.irregularity * sizes_[v] * Vec3(x, y, z);
            move -= normals_[v].dot(move) * normals_[v];
            try_move(v, position(v) + move);
        }
    }

    /// Random collapses of edges, mostly short and flat ones, onto one of their ends, down to the
    /// number of vertices that is wanted.
    void simplify()
    {
        // The part of the candidates that is tried in a round, and how strictly.
        double share = 0.125;
        double strict = 1.0;
        for (int round = 0; round < 40 && mesh_.live_vertex_count() > options_.vertices; ++round) {
            const Index before = mesh_.live_vertex_count();
            std::vector<std::pair<double, Index>> candidates;
            for (Index h = 0; h < mesh_.halfedge_count(); ++h) {
                const double chance = random_.unit();
                if (mesh_.has_halfedge(h) && !locked_[mesh_.tail(h)]) {
                    const double bend = 1.0 - normals_[mesh_.tail(h)].dot(normals_[mesh_.head(h)]);
                    const double cost =
                        (0.4 + chance) * (1.0 + 12.0 * bend) * length(h) / wanted_length(h);
                    candidates.push_back({cost, h});
                }
            }
            std::sort(candidates.begin(), candidates.end());
            // A part at a time, since costs change.
            candidates.resize(static_cast<std::size_t>(share * candidates.size()));
            for (const auto& [cost, h] : candidates) {
                if (mesh_.live_vertex_count() <= options_.vertices) {
                    break;
                }
                if (mesh_.has_halfedge(h) && !locked_[mesh_.tail(h)] && mesh_.can_collapse(h) &&
                    collapse_is_fair(h, strict)) {
                    mesh_.collapse(h);
                }
            }
            if (before - mesh_.live_vertex_count() < before / 50) {
                strict = share < 1.0 ? strict : std::max(0.0, strict - 0.25);
                share = std::min(1.0, 2.0 * share);
            }
            // The more irregular, the fewer flips.
            for (Index h = 0; h < mesh_.halfedge_count(); ++h) {
                const double chance = random_.unit();
                if (chance > 0.45 * options_.irregularity && first_of_edge(h) && !on_boundary(h) &&
                    not_delaunay(h) && mesh_.can_flip(h) && flip_fits(h)) {
                    mesh_.flip(h);
                }
            }
        }
    }

    bool collapse_is_fair(Index h, double strict) const
    {
        const Index a = mesh_.tail(h);
        const Index b = mesh_.head(h);
        bool good = true;
        mesh_.for_outgoing(a, [&](Index g) {
            const Index c = mesh_.head(g);
            const Index d = mesh_.apex(g);
            if (c != b && d != b && good) {
                const auto [largest, smallest] =
                    angle_cosines(position(b), position(c), position(d));
                // Angles between 10 and 150 degrees.
                good = looks_out(b, position(b), c, d, 0.15 + 0.55 * strict) &&
                       largest > -1.0 + 0.134 * strict && smallest < 1.0 - 0.0152 * strict;
            }
        });
        return good;
    }

    /// Removes triangles with angles below 4 degrees by the first flip, collapse or move that
    /// leaves larger ones. Returns whether there were any.
    bool mend()
    {
        bool any = false;
        for (Index f = 0; f < mesh_.face_count(); ++f) {
            if (!mesh_.has_face(f) || sharpness(f) < 0.9976) {
                continue;
            }
            any = true;
            bool done = false;
            for (Index h = 3 * f; h < 3 * f + 3 && !done; ++h) {
                if (!on_boundary(h) && mesh_.can_flip(h) && flip_helps(h)) {
                    mesh_.flip(h);
                    done = true;
                }
            }
            for (Index i = 0; i < 6 && !done; ++i) {
                const Index h = i < 3 ? 3 * f + i : mesh_.opposite(3 * f + i - 3);
                if (h != kNone && !locked_[mesh_.tail(h)] && mesh_.can_collapse(h) &&
                    collapse_helps(h, sharpness(f))) {
                    mesh_.collapse(h);
                    done = true;
                }
            }
            for (Index h = 3 * f; h < 3 * f + 3 && !done; ++h) {
                done = move_helps(mesh_.tail(h));
            }
        }
        return any;
    }

    /// The cosine of the smallest angle.
    double sharpness(Index f) const
    {
        const auto [a, b, c] = mesh_.face(f);
        return angle_cosines(position(a), position(b), position(c))[1];
    }

    double largest_sharpness(Index v) const
    {
        double result = 0.0;
        mesh_.for_outgoing(v, [&](Index h) { result = std::max(result, sharpness(h / 3)); });
        return result;
    }

    bool flip_helps(Index h) const
    {
        const Index g = mesh_.opposite(h);
        const Index a = mesh_.tail(h);
        const Index b = mesh_.head(h);
        const Index c = mesh_.apex(h);
        const Index d = mesh_.apex(g);
        const double before = std::max(sharpness(h / 3), sharpness(g / 3));
        const double after = std::max(angle_cosines(position(d), position(c), position(a))[1],
                                      angle_cosines(position(c), position(d), position(b))[1]);
        return after < before - 1e-6 && looks_out(d, position(d), c, a) &&
               looks_out(c, position(c), d, b);
    }

    bool collapse_helps(Index h, double before) const
    {
        const Index a = mesh_.tail(h);
        const Index b = mesh_.head(h);
        bool good = true;
        mesh_.for_outgoing(a, [&](Index g) {
            const Index c = mesh_.head(g);
            const Index d = mesh_.apex(g);
            if (c != b && d != b && good) {
                good = looks_out(b, position(b), c, d) &&
                       angle_cosines(position(b), position(c), position(d))[1] < before - 1e-6;
            }
        });
        return good;
    }

    /// Moves v towards the middle of its neighbours, if that makes its faces better.
    bool move_helps(Index v)
    {
        if (locked_[v] || mesh_.is_boundary(v)) {
            return false;
        }
        Vec3 center = Vec3::Zero();
        double count = 0.0;
        mesh_.for_neighbors(v, [&](Index w) {
            center += position(w);
            count += 1.0;
        });
        const Vec3 old_position = position(v);
        const Vec3 old_normal = normals_[v];
        const double before = largest_sharpness(v);
        try_move(v, 0.5 * (old_position + center / count));
        if (largest_sharpness(v) < before) {
            return true;
        }
        mesh_.positions[v] = old_position;
        normals_[v] = old_normal;
        return false;
    }

    const Solid& solid_;
    const std::optional<CutPlane>& cut_;
    const RemeshOptions& options_;
    Random random_;
    EditableMesh mesh_;
    std::vector<Vec3> normals_;
    /// Wanted edge lengths.
    std::vector<double> sizes_;
    std::vector<char> locked_;
    std::vector<Index> anchors_;
};

}  // namespace

Remeshed remesh(const Solid& solid, const RawSurface& surface, const std::optional<CutPlane>& cut,
                const std::vector<Anchor>& anchors, const RemeshOptions& options)
{
    Remesher remesher(solid, surface, cut, options);
    remesher.run(anchors);
    return remesher.result();
}

}  // namespace layout_embedding::shapes
