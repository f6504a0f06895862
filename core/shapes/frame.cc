#include "shapes/frame.hh"

#include <cmath>

namespace layout_embedding::shapes {

namespace {

constexpr double kRadiansPerDegree = 0.017453292519943295;

/// Taylor series, for at most 45 degrees.
double small_sine(double x)
{
    const double s = x * x;
    double term = x;
    double sum = x;
    for (int n = 2; n <= 18; n += 2) {
        term *= -s / (n * (n + 1));
        sum += term;
    }
    return sum;
}

double small_cosine(double x)
{
    const double s = x * x;
    double term = 1.0;
    double sum = 1.0;
    for (int n = 1; n <= 17; n += 2) {
        term *= -s / (n * (n + 1));
        sum += term;
    }
    return sum;
}

}  // namespace

double sine(double degrees)
{
    // Whole quarter turns go first; at most 45 degrees are left.
    const double quarters = std::floor(degrees / 90.0 + 0.5);
    const double rest = (degrees - 90.0 * quarters) * kRadiansPerDegree;
    switch (static_cast<long long>(quarters) & 3) {
        case 0:
            return small_sine(rest);
        case 1:
            return small_cosine(rest);
        case 2:
            return -small_sine(rest);
        default:
            return -small_cosine(rest);
    }
}

double cosine(double degrees)
{
    return sine(degrees + 90.0);
}

Frame Frame::turned_x(double degrees) const
{
    const double c = cosine(degrees);
    const double s = sine(degrees);
    Frame result = *this;
    result.axes.col(1) = c * y() + s * z();
    result.axes.col(2) = c * z() - s * y();
    return result;
}

Frame Frame::turned_y(double degrees) const
{
    const double c = cosine(degrees);
    const double s = sine(degrees);
    Frame result = *this;
    result.axes.col(2) = c * z() + s * x();
    result.axes.col(0) = c * x() - s * z();
    return result;
}

Frame Frame::turned_z(double degrees) const
{
    const double c = cosine(degrees);
    const double s = sine(degrees);
    Frame result = *this;
    result.axes.col(0) = c * x() + s * y();
    result.axes.col(1) = c * y() - s * x();
    return result;
}

}  // namespace layout_embedding::shapes
