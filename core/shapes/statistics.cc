#include "shapes/statistics.hh"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

namespace layout_embedding::shapes {

namespace {

double quantile(std::vector<double>& values, double share)
{
    const auto place = values.begin() + static_cast<std::ptrdiff_t>(share * (values.size() - 1));
    std::nth_element(values.begin(), place, values.end());
    return *place;
}

}  // namespace

MeshStatistics mesh_statistics(const TriangleMesh& mesh)
{
    MeshStatistics result{};
    std::vector<double> lengths;
    double sum = 0.0;
    double squares = 0.0;
    for (Index e = 0; e < mesh.edge_count(); ++e) {
        const Index h = mesh.halfedge(e);
        const double length = (mesh.position(mesh.head(h)) - mesh.position(mesh.tail(h))).norm();
        lengths.push_back(length);
        sum += length;
        squares += length * length;
    }
    const double mean = sum / lengths.size();
    result.length_variation =
        std::sqrt(std::max(0.0, squares / lengths.size() - mean * mean)) / mean;
    result.length_low = quantile(lengths, 0.05) / mean;
    result.length_high = quantile(lengths, 0.95) / mean;

    std::vector<double> smallest;
    double obtuse = 0.0;
    for (Index f = 0; f < mesh.face_count(); ++f) {
        double least = 180.0;
        for (Index h = 3 * f; h < 3 * f + 3; ++h) {
            const Vec3& corner = mesh.position(mesh.tail(h));
            const Vec3 a = mesh.position(mesh.head(h)) - corner;
            const Vec3 b = mesh.position(mesh.tail(TriangleMesh::previous(h))) - corner;
            const double angle = std::atan2(a.cross(b).norm(), a.dot(b)) * 57.29577951308232;
            least = std::min(least, angle);
            obtuse += angle > 100.0 ? 1.0 : 0.0;
        }
        smallest.push_back(least);
        result.smallest_angle_mean += least / mesh.face_count();
    }
    result.smallest_angle_low = quantile(smallest, 0.01);
    result.obtuse_share = 100.0 * obtuse / mesh.halfedge_count();

    double inner = 0.0;
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
        if (mesh.is_boundary_vertex(v)) {
            continue;
        }
        int valence = 0;
        Index h = mesh.outgoing(v);
        do {
            ++valence;
            h = mesh.rotated_ccw(h);
        } while (h != mesh.outgoing(v));
        result.valence_share[std::clamp(valence - 4, 0, 4)] += 1.0;
        result.largest_valence = std::max(result.largest_valence, valence);
        inner += 1.0;
    }
    for (double& share : result.valence_share) {
        share *= 100.0 / inner;
    }
    return result;
}

std::string statistics_head()
{
    return "mesh                              vertices  length: var    5%   95%  "
           "least angle: mean    1%  >100deg%  valence %: <=4    5    6    7   >7   max\n";
}

std::string statistics_line(const std::string& name, const TriangleMesh& mesh)
{
    const MeshStatistics s = mesh_statistics(mesh);
    char line[256];
    std::snprintf(line, sizeof line,
                  "%-32s %9u %12.2f %5.2f %5.2f %18.1f %5.1f %9.1f %15.1f %4.1f %4.1f %4.1f %4.1f "
                  "%5d\n",
                  name.c_str(), mesh.vertex_count(), s.length_variation, s.length_low,
                  s.length_high, s.smallest_angle_mean, s.smallest_angle_low, s.obtuse_share,
                  s.valence_share[0], s.valence_share[1], s.valence_share[2], s.valence_share[3],
                  s.valence_share[4], s.largest_valence);
    return line;
}

}  // namespace layout_embedding::shapes
