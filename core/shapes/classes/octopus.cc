// Octopuses: the mantle up along y, the eyes towards z, eight arms around.

#include <array>

#include "shapes/classes/classes.hh"

namespace layout_embedding::shapes {

namespace {

struct Animal {
    const char* name;
    /// Of the mantle.
    double height;
    double width;
    double tilt;
    double arm;
    double radius;
    /// Degrees: how far arms point down where they leave, how much they rise towards their tips,
    /// how much they wind sideways, and how these differ from arm to arm.
    double drop;
    double rise;
    double wind;
    double variation;
    double web;
};

const std::array<Animal, 8> kAnimals{{
    {"resting", 1.0, 0.52, -8, 1.9, 0.17, 34, 78, 50, 0.4, 0.16},
    {"swimming", 1.25, 0.48, -34, 2.2, 0.15, 78, 34, 12, 0.3, 0.22},
    {"walking", 0.9, 0.56, -14, 1.6, 0.19, 52, 110, 26, 0.6, 0.14},
    {"curled", 0.95, 0.54, 0, 2.3, 0.18, 18, 60, 150, 0.5, 0.16},
    {"star", 0.8, 0.6, 0, 2.0, 0.18, 6, 10, 8, 0.2, 0.3},
    {"slender", 1.3, 0.4, -10, 2.8, 0.11, 30, 60, 60, 0.3, 0.1},
    {"round", 0.85, 0.66, -4, 1.3, 0.2, 40, 120, 40, 0.5, 0.26},
    {"waving", 1.05, 0.5, -10, 2.1, 0.16, 2, -96, 40, 0.7, 0.16},
}};

Figure octopus_figure(Index member)
{
    const Animal& animal = kAnimals[member];
    Figure figure;
    Solid& solid = figure.solid;
    const Frame base;
    const double w = animal.width;
    const Frame mantle = base.moved(0, 0.5 * w, 0).turned_x(animal.tilt);
    solid.sweep({{mantle.point(0, -0.1, 0), 0.66 * w},
                 {mantle.point(0, 0.35 * animal.height, 0), 0.8 * w},
                 {mantle.point(0, 0.7 * animal.height, 0), w},
                 {mantle.point(0, animal.height + 0.1, 0), 0.72 * w}},
                {}, {mantle, {1, 1, 0.94}}, 6);
    solid.ellipsoid(base.moved(0, 0.05, 0), {0.62 * w + 0.1, 0.3, 0.62 * w + 0.1}, {0.2});

    figure.landmark("mantle_top", mantle.point(0, 0.7 * animal.height, 0), mantle.y());
    figure.landmark("mantle_back", mantle.point(0, 0.6 * animal.height, 0), -mantle.z());
    figure.landmark("forehead", mantle.point(0, 0.55 * animal.height, 0), mantle.z());
    figure.landmark("mouth", base.point(0, 0.05, 0), -base.y());
    for (const double side : {1.0, -1.0}) {
        const Frame eye = mantle.moved(0.5 * w * side, 0.16 * animal.height, 0.5 * w);
        solid.ellipsoid(eye, Vec3::Constant(0.19 * w + 0.03), {0.06});
        figure.landmark(side_name(side, "eye"), eye.origin, eye.direction(0.6 * side, 0.25, 0.75));
    }
    for (int arm = 0; arm < 8; ++arm) {
        const double turn = 22.5 + 45.0 * arm;
        // Unequal arms without a random generator: three incommensurable waves.
        const double wave = sine(137.5 * (arm + 1) + 61.0 * member);
        const double other = sine(222.5 * (arm + 2) + 43.0 * member);
        const double length = animal.arm * (1.0 + 0.14 * other);
        Frame bone = base.turned_y(turn)
                         .moved(0, 0.05, 0.45 * w)
                         .turned_x(animal.drop * (1.0 + 0.3 * animal.variation * other));
        const double rise = animal.rise * (1.0 + 0.35 * animal.variation * wave);
        // Arms wind the same way round, so that they stay apart.
        const double wind = animal.wind * (1.0 + 0.25 * animal.variation * other);
        std::vector<Knot> knots;
        const int count = 12;
        Vec3 middle_up = bone.y();
        for (int i = 0; i <= count; ++i) {
            const double t = static_cast<double>(i) / count;
            knots.push_back(
                {bone.origin, 0.028 + animal.radius * (1.0 - 0.88 * t * (1.25 - 0.25 * t))});
            if (i == count / 2) {
                middle_up = bone.y();
            }
            const double later = 2.0 * t;
            bone = bone.moved(0, 0, length / count)
                       .turned_x(-rise / count * later)
                       .turned_y(wind / count * later);
        }
        const std::string name = "arm_" + std::to_string(arm + 1);
        figure.landmark(name + "_tip", knots.back().position,
                        knots.back().position - knots[count - 1].position);
        figure.landmark(name + "_middle", knots[count / 2].position, middle_up);
        solid.sweep(knots, {animal.web, knots[1].position, 0.36}, {}, 3);
    }
    for (int arm = 0; arm < 8; ++arm) {
        const Frame between = base.turned_y(45.0 * (arm + 1)).turned_x(0.5 * animal.drop);
        figure.landmark("web_" + std::to_string(arm + 1), between.point(0, 0.03, 0.3 * w),
                        between.z());
    }
    figure.detail = 0.031;
    return figure;
}

}  // namespace

ShapeClass octopuses()
{
    ShapeClass result{"octopus", "Octopuses", 0, 0, {}, octopus_figure};
    for (const Animal& animal : kAnimals) {
        result.members.emplace_back(animal.name);
    }
    return result;
}

}  // namespace layout_embedding::shapes
