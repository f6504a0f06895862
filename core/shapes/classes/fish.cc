// Fish, looking along z, the back up along y. The body is about two units long.

#include <array>

#include "shapes/classes/classes.hh"

namespace layout_embedding::shapes {

namespace {

struct Fish {
    const char* name;
    double length;
    /// Half of the height, and the width as a part of the height.
    double height;
    double width;
    /// Where along the body it is highest, 0 at the tail.
    double peak;
    double tail_height;
    double tail_length;
    double fork;
    double dorsal;
    double dorsal_length;
    double pectoral;
    double anal;
    /// Degrees by which the body bends sideways.
    double bend;
    double snout;
};

const std::array<Fish, 9> kFish{{
    {"trout", 2.0, 0.27, 0.62, 0.6, 0.34, 0.36, 0.14, 0.24, 0.42, 0.34, 0.18, 16, 0.0},
    {"goldfish", 1.3, 0.36, 0.8, 0.62, 0.5, 0.55, 0.26, 0.3, 0.6, 0.4, 0.26, -20, 0.0},
    {"angelfish", 1.2, 0.55, 0.3, 0.58, 0.4, 0.36, 0.06, 0.7, 0.5, 0.36, 0.7, 0, 0.1},
    {"tuna", 2.2, 0.33, 0.72, 0.62, 0.56, 0.22, 0.16, 0.26, 0.22, 0.4, 0.24, 12, 0.1},
    {"shark", 2.5, 0.3, 0.84, 0.64, 0.5, 0.34, 0.26, 0.42, 0.3, 0.62, 0.2, 26, 0.22},
    {"eel", 3.0, 0.17, 0.96, 0.7, 0.17, 0.2, 0.02, 0.12, 1.0, 0.2, 0.12, 100, 0.0},
    {"puffer", 1.5, 0.44, 0.98, 0.56, 0.26, 0.3, 0.02, 0.18, 0.3, 0.26, 0.16, 10, 0.0},
    {"carp", 1.8, 0.36, 0.6, 0.64, 0.4, 0.4, 0.16, 0.26, 0.8, 0.34, 0.2, -34, 0.0},
    {"swordfish", 2.2, 0.28, 0.72, 0.66, 0.58, 0.26, 0.2, 0.46, 0.34, 0.42, 0.2, -16, 0.85},
}};

Figure fish_figure(Index member)
{
    const Fish& fish = kFish[member];
    Figure figure;
    Solid& solid = figure.solid;

    // Frames along the spine, from the head back; the bend grows towards the tail.
    const int count = 16;
    std::vector<Frame> spine;
    Frame bone = Frame{}.moved(0, 0, 0.5 * fish.length).turned_y(-0.12 * fish.bend);
    for (int i = 0; i <= count; ++i) {
        spine.push_back(bone);
        const double t = static_cast<double>(i) / count;
        bone =
            bone.moved(0, 0, -fish.length / count)
                .turned_y(2.0 * t * fish.bend / count * (fish.bend > 60 ? cosine(330 * t) : 1.0));
    }
    const auto at = [&](double t) { return spine[static_cast<std::size_t>(t * count + 0.5)]; };
    // Height of the body at a part t of the way back: rises to the peak, falls to the tail's root.
    const double peak = 1.0 - fish.peak;
    const auto height = [&](double t) {
        const double root = 0.2 * fish.tail_height;
        if (t < peak) {
            // Between the roundness of an ellipse and a wedge.
            const double x = 1.0 - t / peak;
            return fish.height * (0.15 + 0.4 * std::sqrt(1.0 - x * x) + 0.45 * (1.0 - x * x));
        }
        const double x = (t - peak) / (1.0 - peak);
        const double fall = x * x * (3.0 - 2.0 * x);
        return fish.height + fall * (root - fish.height);
    };
    std::vector<Knot> body;
    const int first = 1;
    for (int i = first; i <= count; ++i) {
        body.push_back({spine[i].origin, height(static_cast<double>(i) / count)});
    }
    solid.sweep(body, {}, {Frame{}, {fish.width, 1, 1}}, 2);
    // The snout.
    const Frame head = at(0.06);
    const double front = height(0.06) * 0.55;
    solid.sweep({{head.point(0, -0.05 * fish.height, -0.1), front},
                 {head.point(0, -0.1 * fish.height, 0.06 + fish.snout),
                  fish.snout > 0.5 ? 0.028 : 0.5 * front}},
                {0.15}, {Frame{}, {std::max(fish.width, 0.5), 1, 1}});
    figure.landmark("mouth", head.point(0, -0.1 * fish.height, 0.06 + fish.snout), head.z());

    // Fins are thin tubes, squashed sideways.
    const double thin = 0.45;
    const auto fin = [&](const Frame& frame, const std::vector<Knot>& knots, double blend) {
        solid.sweep(knots, {blend}, {frame, {thin, 1, 1}});
    };
    const Frame root = spine[count];
    const double th = fish.tail_height;
    const double tl = fish.tail_length;
    for (const double side : {1.0, -1.0}) {
        fin(root,
            {{root.point(0, 0, 0.05), 0.085},
             {root.point(0, 0.5 * th * side, -0.5 * tl), 0.12},
             {root.point(0, th * side, -tl - 0.4 * fish.fork), 0.06}},
            0.06);
    }
    fin(root, {{root.point(0, 0, 0), 0.09}, {root.point(0, 0, -tl + fish.fork), 0.11}}, 0.1);
    figure.landmark("tail_upper", root.point(0, 0.985 * th, -tl - 0.39 * fish.fork),
                    root.direction(0, 0.8, -0.6));
    figure.landmark("tail_lower", root.point(0, -0.985 * th, -tl - 0.39 * fish.fork),
                    root.direction(0, -0.8, -0.6));
    figure.landmark("tail_middle", root.point(0, 0, -tl + fish.fork), -root.z());

    const Frame top = at(peak + 0.02);
    const double d = fish.dorsal;
    const double back = std::min(0.9, peak + fish.dorsal_length / fish.length);
    const Frame behind = at(back);
    const Frame halfway = at(0.5 * (peak + back));
    fin(top,
        {{top.point(0, 0.75 * height(peak), 0.1), 0.12},
         {halfway.point(0, height(0.5 * (peak + back)) + 0.55 * d, 0.08), 0.13},
         {halfway.point(0, height(0.5 * (peak + back)) + d, -0.12), 0.055}},
        0.08);
    fin(halfway,
        {{halfway.point(0, 0.8 * height(0.5 * (peak + back)), 0.1), 0.13},
         {behind.point(0, height(back) - 0.02, 0), 0.075}},
        0.12);
    figure.landmark("dorsal_tip", halfway.point(0, height(0.5 * (peak + back)) + 0.99 * d, -0.118),
                    halfway.direction(0, 0.9, -0.4));
    figure.landmark("back_front", at(0.2).origin, at(0.2).y());

    const Frame under = at(0.72);
    const double under_height = height(0.72);
    fin(under,
        {{under.point(0, -0.6 * under_height, 0.1), 0.1},
         {under.point(0, -under_height - 0.6 * fish.anal, -0.05), 0.1},
         {under.point(0, -under_height - fish.anal, -0.2), 0.055}},
        0.08);
    figure.landmark("anal_tip", under.point(0, -under_height - 0.99 * fish.anal, -0.198),
                    under.direction(0, -0.8, -0.6));
    figure.landmark("belly", at(0.42).origin, -at(0.42).y());
    figure.landmark("tail_root_top", at(0.94).origin, at(0.94).y());
    figure.landmark("tail_root_bottom", at(0.94).origin, -at(0.94).y());

    for (const double side : {1.0, -1.0}) {
        const Frame gill = at(0.28);
        const double x = 0.78 * fish.width * height(0.28);
        const Frame joint =
            gill.moved(x * side, -0.3 * fish.height, 0).turned_y(-side * 42).turned_z(-side * 26);
        const double p = fish.pectoral;
        solid.sweep({{joint.point(-0.04 * side, 0, 0.04), 0.065},
                     {joint.point(0.55 * p * side, 0, -0.1), 0.1},
                     {joint.point(p * side, 0, -0.3 * p), 0.055}},
                    {0.05, joint.origin, 0.12}, {joint, {1, 0.45, 1}});
        figure.landmark(side_name(side, "pectoral_tip"),
                        joint.point(0.99 * p * side, 0, -0.298 * p),
                        joint.direction(side, 0, -0.4));
        const Frame face = at(0.13);
        Frame eye = face;
        const Vec3 aside = face.direction(side, 0.3, 0.25);
        eye.origin = solid.exit(face.origin, aside, 1.0, 0.02).value_or(face.origin) - 0.02 * aside;
        solid.ellipsoid(eye, Vec3::Constant(0.05 + 0.05 * fish.height), {0.03});
        figure.landmark(side_name(side, "eye"), eye.origin, eye.direction(side, 0.1, 0.15));
        const Frame flank = at(0.5);
        figure.landmark(side_name(side, "flank"), flank.origin, side * flank.x());
    }
    figure.detail = 0.024;
    return figure;
}

}  // namespace

ShapeClass fish()
{
    ShapeClass result{"fish", "Fish", 0, 0, {}, fish_figure};
    for (const Fish& animal : kFish) {
        result.members.emplace_back(animal.name);
    }
    return result;
}

}  // namespace layout_embedding::shapes
