#include "formats/refined_svg.hh"

#include <algorithm>
#include <cmath>

#include "formats/patch_colours.hh"

namespace layout_embedding {
namespace {

constexpr double kMargin = 8;

/// Something to draw, the farthest first.
struct Shape {
    double depth;
    Index id;  // a triangle, or behind all of them a chain segment
};

void append_fixed(std::string& text, double value)
{
    // Two digits behind the point.
    const auto hundredths = static_cast<std::int64_t>(std::floor(value * 100 + 0.5));
    text += std::to_string(hundredths / 100);
    const std::int64_t rest = hundredths % 100;
    if (rest != 0) {
        text += rest < 10 ? ".0" : ".";
        text += std::to_string(rest % 10 == 0 && rest >= 10 ? rest / 10 : rest);
    }
}

std::string hexadecimal(const Colour& colour, double light)
{
    constexpr std::string_view kDigits = "0123456789abcdef";
    std::string text = "#";
    for (const std::uint8_t part : colour) {
        const auto value = static_cast<std::size_t>(part * light + 0.5);
        text += kDigits[value / 16];
        text += kDigits[value % 16];
    }
    return text;
}

class SvgWriter {
public:
    SvgWriter(const RefinedMesh& refined, const View& view) : refined_(refined)
    {
        const Vec3 toward = view.direction.normalized();
        Vec3 right = view.up.cross(toward);
        if (!(right.norm() > 1e-9 * view.up.norm())) {
            // Looking along what is up: any other way up will do.
            int axis = 0;
            toward.cwiseAbs().minCoeff(&axis);
            right = Vec3::Unit(axis).cross(toward);
        }
        right.normalize();
        const Vec3 up = toward.cross(right);
        points_.reserve(refined.positions.size());
        for (const Vec3& p : refined.positions) {
            points_.emplace_back(right.dot(p), -up.dot(p), toward.dot(p));
        }
        Vec3 low = points_.empty() ? Vec3(0, 0, 0) : points_[0];
        Vec3 high = low;
        for (const Vec3& p : points_) {
            low = low.cwiseMin(p);
            high = high.cwiseMax(p);
        }
        const Vec3 size = high - low;
        const double scale =
            (view.width - 2 * kMargin) / std::max({size.x(), 1e-3 * size.y(), 1e-300});
        width_ = view.width;
        height_ = std::ceil(size.y() * scale + 2 * kMargin);
        for (Vec3& p : points_) {
            p = (p - low) * scale + Vec3(kMargin, kMargin, 0);
        }
        depth_ = size.z() * scale;
    }

    std::string write()
    {
        collect();
        std::sort(shapes_.begin(), shapes_.end(), [](const Shape& a, const Shape& b) {
            return a.depth != b.depth ? a.depth < b.depth : a.id < b.id;
        });
        std::string svg = "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"";
        append_fixed(svg, width_);
        svg += "\" height=\"";
        append_fixed(svg, height_);
        svg += "\" viewBox=\"0 0 ";
        append_fixed(svg, width_);
        svg += ' ';
        append_fixed(svg, height_);
        svg += "\">\n<g stroke-linejoin=\"round\" stroke-linecap=\"round\" stroke-width=\"0.5\">\n";
        // Shapes of one look in a row share an element.
        std::string look;
        for (const Shape& shape : shapes_) {
            const std::string next = look_of(shape);
            if (next != look) {
                svg += look.empty() ? "" : "\"/>\n";
                svg += "<path " + next + " d=\"";
                look = next;
            }
            append_path(svg, shape);
        }
        svg += look.empty() ? "" : "\"/>\n";
        return svg + "</g>\n</svg>\n";
    }

private:
    void collect()
    {
        colours_ = triangle_colours(refined_);
        std::vector<bool> seen(points_.size(), false);  // vertices of what is not turned away
        for (Index t = 0; t < refined_.triangle_patches.size(); ++t) {
            const Index* c = &refined_.corners[3 * std::size_t{t}];
            const Vec3 normal = normal_of(t);
            light_.push_back(0.55 + 0.45 * std::max(normal.z(), 0.0));
            // y points down, which turns everything over.
            if (normal.z() > 0) {
                shapes_.push_back(
                    {(points_[c[0]].z() + points_[c[1]].z() + points_[c[2]].z()) / 3, t});
                seen[c[0]] = seen[c[1]] = seen[c[2]] = true;
            }
        }
        // Lines lie on the surface and must not sink into it.
        const double lift = 0.01 * depth_;
        Index id = static_cast<Index>(refined_.triangle_patches.size());
        for (const std::vector<Index>& chain : refined_.chains) {
            for (std::size_t i = 1; i < chain.size(); ++i, ++id) {
                segments_.push_back({chain[i - 1], chain[i]});
                if (seen[chain[i - 1]] && seen[chain[i]]) {
                    shapes_.push_back(
                        {(points_[chain[i - 1]].z() + points_[chain[i]].z()) / 2 + lift, id});
                }
            }
        }
    }

    /// Towards the eye is +z.
    Vec3 normal_of(Index t) const
    {
        const Index* c = &refined_.corners[3 * std::size_t{t}];
        Vec3 normal = (points_[c[1]] - points_[c[0]]).cross(points_[c[2]] - points_[c[0]]);
        normal = Vec3(normal.x(), normal.y(), -normal.z());
        return normal.norm() > 0 ? normal.normalized() : Vec3(0, 0, 0);
    }

    std::string look_of(const Shape& shape) const
    {
        if (shape.id >= colours_.size()) {
            return "fill=\"none\" stroke=\"" + hexadecimal(kPathColour, 1) +
                   "\" stroke-width=\"2\"";
        }
        // A line of the same colour closes the hair cracks between triangles.
        const std::string colour =
            hexadecimal(patch_palette()[colours_[shape.id]], light_[shape.id]);
        return "fill=\"" + colour + "\" stroke=\"" + colour + "\"";
    }

    void append_path(std::string& svg, const Shape& shape) const
    {
        const auto append = [&](char command, Index vertex) {
            svg += command;
            append_fixed(svg, points_[vertex].x());
            svg += ' ';
            append_fixed(svg, points_[vertex].y());
        };
        if (shape.id >= colours_.size()) {
            const auto& [from, to] = segments_[shape.id - colours_.size()];
            append('M', from);
            append('L', to);
            return;
        }
        const Index* c = &refined_.corners[3 * std::size_t{shape.id}];
        append('M', c[0]);
        append('L', c[1]);
        append('L', c[2]);
        svg += 'Z';
    }

    const RefinedMesh& refined_;
    std::vector<Vec3> points_;  // in the picture; z towards the eye
    double width_ = 0;
    double height_ = 0;
    double depth_ = 0;
    std::vector<Index> colours_;
    std::vector<double> light_;
    std::vector<std::array<Index, 2>> segments_;
    std::vector<Shape> shapes_;
};

}  // namespace

Result<std::string> write_refined_svg(const RefinedMesh& refined, const View& view)
{
    if (!view.direction.allFinite() || !view.up.allFinite() || !(view.direction.norm() > 0) ||
        !(view.width > 2 * kMargin && view.width < 1e6)) {
        return make_error(ErrorCode::invalidOption,
                          "the view of a picture has no direction or no width in pixels");
    }
    return SvgWriter(refined, view).write();
}

}  // namespace layout_embedding
