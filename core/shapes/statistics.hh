#pragma once

#include <string>

#include "mesh/triangle_mesh.hh"

namespace layout_embedding::shapes {

/// What tells a scanned or simplified mesh from a grid.
struct MeshStatistics {
    /// Standard deviation of the edge lengths over their mean, and the lengths that 5 and 95 per
    /// cent of the edges stay below, over the mean.
    double length_variation;
    double length_low;
    double length_high;
    /// Of the triangles' smallest angles in degrees: the mean, and what 1 per cent stay below.
    double smallest_angle_mean;
    double smallest_angle_low;
    /// Percentage of angles above 100 degrees.
    double obtuse_share;
    /// Percentages of inner vertices of valence up to 4, 5, 6, 7, and above.
    double valence_share[5];
    int largest_valence;
};

MeshStatistics mesh_statistics(const TriangleMesh& mesh);

/// As one line of a table, and the table's head.
std::string statistics_head();
std::string statistics_line(const std::string& name, const TriangleMesh& mesh);

}  // namespace layout_embedding::shapes
