#include "shapes/map_check.hh"

#include <algorithm>
#include <cstdio>
#include <ctime>
#include <memory>
#include <optional>
#include <string>

#include "apps/embed_job.hh"
#include "apps/quad_mesh.hh"
#include "apps/surface_map.hh"
#include "apps/template_layout.hh"

namespace layout_embedding::shapes {
namespace {

double cpu_seconds()
{
    return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

struct Embedded {
    MappedTarget target;
    QuadMesh quads;
    /// CPU time of the quads.
    double seconds;
};

/// A checked embedding and its quads; prints why there is none.
std::optional<Embedded> embed_member(const std::shared_ptr<const Layout>& layout,
                                     const Shape& shape, const QuadOptions& options)
{
    const auto problem =
        make_problem(layout, std::make_shared<const TriangleMesh>(shape.mesh), shape.landmarks);
    if (!problem) {
        std::printf("%s\n", problem.error().message.c_str());
        return std::nullopt;
    }
    EmbedJob job(*problem, {});
    while (job.step()) {
    }
    if (!job.result().refined) {
        std::printf("no embedding %s\n", job.error().message.c_str());
        return std::nullopt;
    }
    const double start = cpu_seconds();
    auto quads = make_quad_mesh(*layout, *problem->target, *job.result().refined, options);
    if (!quads) {
        std::printf("%s\n", quads.error().message.c_str());
        return std::nullopt;
    }
    return Embedded{{{problem->target, std::make_shared<const RefinedMesh>(*job.result().refined)},
                     problem->landmarks},
                    std::move(*quads),
                    cpu_seconds() - start};
}

struct MapTotals {
    Index pairs = 0;
    Index complete = 0;
    std::size_t quads = 0;
    std::size_t flipped = 0;
    double least_jacobian = 1;

    /// Prints how good the quads are, too.
    void add(const QuadMesh& mesh)
    {
        const QuadStatistics& statistics = mesh.statistics;
        quads += mesh.quads.size();
        flipped += statistics.flipped;
        least_jacobian = std::min(least_jacobian, statistics.least_jacobian);
        std::printf("%5zu quads, %3u flipped, scaled Jacobian %6.3f to 1, mean %.3f",
                    mesh.quads.size(), statistics.flipped, statistics.least_jacobian,
                    statistics.mean_jacobian);
    }

    std::vector<double> energies;
};

bool check_template(const ShapeClass& shape_class, Index from,
                    const CollectionCheckOptions& options, MapTotals& totals)
{
    const auto make = [&](Index member) {
        return make_shape(shape_class, member, {options.vertices, options.seed});
    };
    const auto source = make(from);
    if (!source) {
        std::printf("%s\n", source.error().message.c_str());
        return false;
    }
    const auto made =
        template_layout(TriangleMesh(source->mesh), source->landmarks, {.quads = true});
    if (!made) {
        std::printf("%s: %s\n", shape_class.name.c_str(), made.error().message.c_str());
        return false;
    }
    auto cells = Layout::from_polygons(made->mesh, "the template");
    if (!cells) {
        std::printf("%s: %s\n", shape_class.name.c_str(), cells.error().message.c_str());
        return false;
    }
    const auto layout = std::make_shared<const Layout>(std::move(*cells));
    const auto first = embed_member(layout, *source, {});
    if (!first) {
        return false;
    }
    std::printf("%-13s %-14s    %-14s ", shape_class.name.c_str(),
                shape_class.members[from].c_str(), "");
    totals.add(first->quads);
    std::printf(", %.1f s\n", first->seconds);
    // All members get the numbers of segments of the first one.
    QuadOptions quad_options;
    quad_options.segments_as = first->quads.segments;
    bool all = true;
    const Index count = shape_class.member_count();
    for (Index step = 1; step <= std::min(options.others, count - 1); ++step) {
        const Index to = (from + step) % count;
        std::printf("%-13s %-14s -> %-14s ", shape_class.name.c_str(),
                    shape_class.members[from].c_str(), shape_class.members[to].c_str());
        ++totals.pairs;
        const auto other = make(to);
        const auto second =
            other ? embed_member(layout, *other, quad_options) : std::optional<Embedded>();
        if (!second) {
            std::fflush(stdout);
            all = false;
            continue;
        }
        const bool same = first->quads.quads == second->quads.quads;
        totals.add(second->quads);
        std::printf("%s, %.1f s%s", same ? "" : " (OTHER CONNECTIVITY)", second->seconds,
                    options.maps ? "; " : "\n");
        all = all && same;
        if (!options.maps) {
            std::fflush(stdout);
            continue;
        }
        const double start = cpu_seconds();
        const auto map = SurfaceMap::make(layout, first->target, second->target);
        const double seconds = cpu_seconds() - start;
        if (!map) {
            std::printf("%s\n", map.error().message.c_str());
            all = false;
            continue;
        }
        std::printf("energy %8.3f -> %7.3f, angles %.3f, areas %.3f, %.1f s\n",
                    map->first_distortion().mean_energy, map->distortion().mean_energy,
                    map->distortion().mean_conformal, map->distortion().mean_area, seconds);
        std::fflush(stdout);
        ++totals.complete;
        totals.energies.push_back(map->distortion().mean_energy);
    }
    return all;
}

}  // namespace

bool check_maps_of_collection(const std::vector<const ShapeClass*>& classes,
                              const std::vector<Index>& templates,
                              const CollectionCheckOptions& options)
{
    MapTotals totals;
    bool all = true;
    for (const ShapeClass* const shape_class : classes) {
        for (const Index from : templates.empty() ? std::vector<Index>{0} : templates) {
            if (from < shape_class->member_count()) {
                all = check_template(*shape_class, from, options, totals) && all;
            }
        }
    }
    if (options.maps) {
        std::printf("%u of %u pairs mapped; ", totals.complete, totals.pairs);
    }
    std::printf("%zu of %zu quads flipped, smallest scaled Jacobian %.3f", totals.flipped,
                totals.quads, totals.least_jacobian);
    if (!totals.energies.empty()) {
        std::sort(totals.energies.begin(), totals.energies.end());
        std::printf("; energy: median %.3f, largest %.3f",
                    totals.energies[totals.energies.size() / 2], totals.energies.back());
    }
    std::printf("\n");
    return all;
}

}  // namespace layout_embedding::shapes
