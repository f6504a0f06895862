#include "patches/domain.hh"

#include <algorithm>

namespace layout_embedding {
namespace {

constexpr double kPi = 3.14159265358979323846;

/// (cos x, sin x) by their Taylor series, for 0 <= x <= pi.
PlanePoint unit_vector(double x)
{
    // Halved three times, the series need few terms; then the angle is doubled again.
    const double y = x / 8;
    PlanePoint result(1, y);
    double term = y;
    for (int n = 2; n <= 15; ++n) {
        term *= y / n;
        result[n % 2] += n % 4 < 2 ? term : -term;
    }
    for (int i = 0; i < 3; ++i) {
        result = PlanePoint(result.x() * result.x() - result.y() * result.y(),
                            2 * result.x() * result.y());
    }
    return result;
}

}  // namespace

Domain regular_polygon(Index n)
{
    Domain corners(n);
    corners[0] = PlanePoint(1, 0);
    // The lower half mirrors the upper one.
    for (Index k = 1; 2 * k <= n; ++k) {
        corners[k] = 2 * k == n ? PlanePoint(-1, 0) : unit_vector(2 * kPi * k / n);
        corners[n - k] = PlanePoint(corners[k].x(), -corners[k].y());
    }
    if (n % 2 == 0) {
        corners[n / 2] = PlanePoint(-1, 0);
    }
    return corners;
}

Domain inscribed_polygon(std::span<const double> lengths)
{
    constexpr double kLeastShare = 0.1;
    double sum = 0;
    for (const double length : lengths) {
        sum += length;
    }
    const double mean = sum > 0 ? sum / static_cast<double>(lengths.size()) : 1;
    double total = 0;
    for (const double length : lengths) {
        total += std::max(length, kLeastShare * mean);
    }
    Domain corners;
    double reached = 0;
    for (const double length : lengths) {
        const double angle = 2 * kPi * (reached / total);
        const PlanePoint corner = unit_vector(angle <= kPi ? angle : 2 * kPi - angle);
        corners.emplace_back(corner.x(), angle <= kPi ? corner.y() : -corner.y());
        reached += std::max(length, kLeastShare * mean);
    }
    return corners;
}

Domain rectangle(double width, double height)
{
    return {PlanePoint(0, 0), PlanePoint(width, 0), PlanePoint(width, height),
            PlanePoint(0, height)};
}

double area(const Domain& domain)
{
    double sum = 0;
    for (std::size_t i = 1; i + 1 < domain.size(); ++i) {
        sum += cross(domain[i] - domain[0], domain[i + 1] - domain[0]);
    }
    return sum / 2;
}

}  // namespace layout_embedding
