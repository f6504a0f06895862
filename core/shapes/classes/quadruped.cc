// Four-legged animals, standing along y and looking along z. One unit is about the length of the
// trunk.

#include <array>

#include "shapes/classes/classes.hh"

namespace layout_embedding::shapes {

namespace {

enum class Ears { pointed, hanging, round, long_upright };

struct Quadruped {
    const char* name;
    /// Trunk: length, radius at chest, belly and rump, and how narrow it is sideways.
    double length;
    double chest;
    double belly;
    double rump;
    double narrow;
    /// Legs: length below the trunk's axis, thickness at top, middle and foot.
    double legs;
    double thigh;
    double shin;
    double foot;
    /// Neck: length, angle above the horizontal, radius.
    double neck;
    double neck_angle;
    double neck_radius;
    /// Head: radius, length and radius of the snout, tilt downwards.
    double head;
    double snout;
    double snout_radius;
    double nod;
    Ears ears;
    double ear;
    /// Tail: length, angle above the horizontal at its root, change to its end, radii.
    double tail;
    double tail_angle;
    double tail_curl;
    double tail_radius;
    double tail_tip;
    /// Legs swing by this angle, front left and hind right forwards, the others back.
    double stride;
    double head_turn;
};

const std::array<Quadruped, 10> kQuadrupeds{{
    {"cat", 1.0, 0.2, 0.19, 0.2,           0.84, 0.52, 0.1, 0.055, 0.062, 0.2,  48, 0.125,
     0.185, 0.1, 0.1, 4,    Ears::pointed, 0.17, 0.95, 50,  70,    0.052, 0.04, 10, 18},
    {"dog", 1.0,  0.235, 0.185, 0.19,          0.82, 0.66, 0.11, 0.052, 0.066, 0.26,  52, 0.13,
     0.165, 0.24, 0.095, 8,     Ears::hanging, 0.21, 0.5,  44,   50,    0.05,  0.026, 14, -10},
    {"horse", 1.15, 0.27, 0.27, 0.27,          0.8,  0.92, 0.145, 0.06, 0.07, 0.62,  52, 0.15,
     0.145,   0.4,  0.1,  42,   Ears::pointed, 0.14, 0.62, -52,   -16,  0.06, 0.075, 16, 0},
    {"cow", 1.2,  0.3,   0.33, 0.29,          0.84, 0.72, 0.145, 0.068, 0.078, 0.3,   24, 0.17,
     0.175, 0.28, 0.125, 30,   Ears::hanging, 0.16, 0.66, -66,   -14,   0.036, 0.045, 8,  12},
    {"giraffe", 0.95, 0.27, 0.24, 0.22,          0.78, 1.25, 0.13, 0.058, 0.066, 1.25,  66, 0.12,
     0.125,     0.28, 0.08, 50,   Ears::pointed, 0.13, 0.6,  -55,  -20,   0.03,  0.036, 9,  8},
    {"pig", 1.05, 0.29, 0.32, 0.28,          0.95, 0.47, 0.12, 0.066, 0.07, 0.14,  18, 0.22,
     0.21,  0.19, 0.1,  10,   Ears::hanging, 0.15, 0.36, 60,   110,   0.03, 0.024, 8,  -8},
    {"elephant", 1.2,  0.4,   0.43, 0.38,        0.9,  0.92, 0.17, 0.125, 0.14, 0.2,   30, 0.24,
     0.27,       0.95, 0.115, 16,   Ears::round, 0.36, 0.6,  -60,  -14,   0.05, 0.034, 8,  0},
    {"mouse", 0.8, 0.2,   0.24, 0.24,        0.95, 0.34, 0.085, 0.044, 0.05,  0.1,  24, 0.15,
     0.175,   0.2, 0.062, 10,   Ears::round, 0.17, 1.05, 8,     46,    0.034, 0.02, 10, 10},
    {"hare", 0.85, 0.19, 0.22, 0.25,  0.86,  0.44,  0.12, 0.05,
     0.062,  0.17, 46,   0.12, 0.165, 0.11,  0.085, 8,    Ears::long_upright,
     0.44,   0.14, 40,   20,   0.075, 0.055, 6,     -12},
    {"fox", 1.05, 0.185, 0.165, 0.175,         0.8, 0.58, 0.09, 0.042, 0.052, 0.25, 40, 0.11,
     0.15,  0.26, 0.06,  6,     Ears::pointed, 0.2, 0.82, -6,   26,    0.07,  0.1,  20, 14},
}};

Figure animal_figure(Index member)
{
    const Quadruped& animal = kQuadrupeds[member];
    Figure figure;
    Solid& solid = figure.solid;
    const double half = 0.5 * animal.length - 0.1;
    const Frame trunk = Frame{}.moved(0, animal.legs, 0);
    solid.sweep({{trunk.point(0, -0.01, -half - 0.02), 0.92 * animal.rump},
                 {trunk.point(0, 0.01, -0.55 * half), animal.rump},
                 {trunk.point(0, -0.02, 0), animal.belly},
                 {trunk.point(0, 0.0, 0.55 * half), animal.chest},
                 {trunk.point(0, 0.02, half), 0.88 * animal.chest}},
                {}, {trunk, {animal.narrow, 1, 1}});

    // Neck and head.
    const Frame neck = trunk.moved(0, 0.1, half - 0.02)
                           .turned_y(0.3 * animal.head_turn)
                           .turned_x(-animal.neck_angle);
    const double start = 0.6 * animal.chest;
    const double reach = start + animal.neck;
    solid.sweep({{neck.point(0, -0.06, 0), 1.35 * animal.neck_radius},
                 {neck.point(0, 0, 0.45 * reach), 1.08 * animal.neck_radius},
                 {neck.point(0, 0, reach), 0.88 * animal.neck_radius}},
                {0.5 * animal.chest}, {neck, {animal.narrow, 1, 1}});
    const Frame skull = neck.moved(0, 0.25 * animal.head, reach + 0.3 * animal.head)
                            .turned_x(animal.neck_angle)
                            .turned_y(0.7 * animal.head_turn)
                            .turned_x(animal.nod);
    const double r = animal.head;
    solid.ellipsoid(skull, Vec3(0.9, 0.92, 1.05) * r, {0.6 * r});
    // The snout; a trunk hangs down and curls.
    const double s = animal.snout;
    const double sr = animal.snout_radius;
    Vec3 nose;
    Vec3 nose_direction = skull.z();
    if (s > 3.0 * r) {
        const Frame root = skull.moved(0, -0.25 * r, 0.75 * r).turned_x(54);
        solid.sweep({{skull.point(0, -0.2 * r, 0.4 * r), 1.5 * sr},
                     {root.point(0, 0.02, 0.25 * s), 0.98 * sr},
                     {root.point(0, -0.02, 0.55 * s), 0.74 * sr},
                     {root.point(0, 0.06, 0.8 * s), 0.58 * sr},
                     {root.point(0, 0.22 * s, 0.98 * s), 0.5 * sr}},
                    {0.14, skull.point(0, 0, 0.6 * r), 0.3}, {}, 6);
        nose = root.point(0, 0.215 * s, 0.975 * s);
        nose_direction = root.direction(0, 0.7, 0.7);
    } else {
        solid.sweep({{skull.point(0, -0.18 * r, 0.35 * r), 0.75 * r},
                     {skull.point(0, -0.26 * r, 0.6 * r + 0.45 * s), 1.08 * sr},
                     {skull.point(0, -0.3 * r, 0.6 * r + s), 0.92 * sr}},
                    {0.35 * r}, {skull, {0.92, 0.95, 1}});
        nose = skull.point(0, -0.22 * r, 0.6 * r + s);
    }
    figure.landmark("nose", nose, nose_direction);
    figure.landmark("forehead", skull.origin, skull.direction(0, 0.75, 0.65));
    figure.landmark("chin", skull.point(0, -0.25 * r, 0.35 * r), skull.direction(0, -1, 0.15));
    figure.landmark("nape", neck.point(0, 0, 0.55 * reach), neck.y());
    figure.landmark("throat", neck.point(0, 0, 0.5 * reach), -neck.y());
    figure.landmark("withers", trunk.point(0, 0, 0.5 * half), trunk.y());
    figure.landmark("back", trunk.point(0, 0, -0.1 * half), trunk.y());
    figure.landmark("breast", trunk.point(0, -0.03, half), trunk.direction(0, -0.35, 1));
    figure.landmark("belly", trunk.point(0, 0, -0.05), -trunk.y());

    // The tail.
    {
        Frame bone = trunk.moved(0, 0.45 * animal.rump, -half - 0.35 * animal.rump)
                         .turned_y(180)
                         .turned_x(-animal.tail_angle);
        std::vector<Knot> knots{{bone.point(0, 0, -0.15), 1.25 * animal.tail_radius}};
        const int count = 6;
        for (int i = 0; i < count; ++i) {
            const double t = static_cast<double>(i) / (count - 1);
            const double swell =
                1.0 + (animal.tail_tip > animal.tail_radius ? 1.6 * t * (1 - t) : 0.0);
            knots.push_back({bone.origin, swell * (animal.tail_radius +
                                                   t * (animal.tail_tip - animal.tail_radius))});
            bone = bone.moved(0, 0, animal.tail / (count - 1))
                       .turned_x(-animal.tail_curl / count)
                       .turned_y(3);
        }
        // A bushy tail ends in a point.
        knots.back().radius = std::min(knots.back().radius, 0.045);
        const Vec3 end = knots.back().position;
        figure.landmark("tail_root", knots[1].position, trunk.direction(0, 1, 0.1));
        figure.landmark("tail_tip", end, end - knots[knots.size() - 2].position);
        solid.sweep(knots, {0.09, knots[0].position, 0.2});
    }

    for (const double side : {1.0, -1.0}) {
        // Ears.
        const double e = animal.ear;
        switch (animal.ears) {
            case Ears::pointed: {
                const Frame ear = skull.moved(0.5 * r * side, 0.6 * r, -0.15 * r)
                                      .turned_z(-22 * side)
                                      .turned_x(-6);
                solid.sweep({{ear.point(0, -0.02, 0), 0.44 * e},
                             {ear.point(0, 0.86 * e, 0), 0.13 * e + 0.01}},
                            {0.05}, {ear, {0.95, 1, 0.55}});
                figure.landmark(side_name(side, "ear"), ear.point(0, 0.88 * e, 0), ear.y());
                break;
            }
            case Ears::hanging: {
                const Frame ear = skull.moved(0.72 * r * side, 0.5 * r, -0.12 * r)
                                      .turned_z(-118 * side)
                                      .turned_y(20 * side);
                solid.sweep({{ear.point(0, -0.03, 0), 0.2 * e},
                             {ear.point(0, 0.45 * e, 0), 0.36 * e},
                             {ear.point(0, 0.92 * e, 0), 0.24 * e}},
                            {0.04, ear.origin, 0.1}, {ear.turned_y(70), {1, 1, 0.6}});
                figure.landmark(side_name(side, "ear"), ear.point(0, 0.92 * e, 0), ear.y());
                break;
            }
            case Ears::round: {
                const Frame ear = skull.moved(0.75 * r * side, 0.4 * r, -0.25 * r)
                                      .turned_y(24 * side)
                                      .turned_z(-56 * side);
                solid.sweep(
                    {{ear.point(0, 0.45 * e, 0), 0.62 * e}, {ear.point(0, 0.75 * e, 0), 0.62 * e}},
                    {0.05}, {ear, {1, 1, 0.3 / (1.0 + 2.0 * e)}});
                figure.landmark(side_name(side, "ear"), ear.point(0, e, 0), ear.y());
                break;
            }
            case Ears::long_upright: {
                const Frame ear = skull.moved(0.36 * r * side, 0.7 * r, -0.2 * r)
                                      .turned_z(-13 * side)
                                      .turned_x(-16);
                solid.sweep({{ear.point(0, -0.04, 0), 0.1 * e},
                             {ear.point(0, 0.5 * e, 0), 0.17 * e},
                             {ear.point(0, e, 0), 0.075 * e}},
                            {0.05, ear.origin, 0.1}, {ear, {1, 1, 0.62}});
                figure.landmark(side_name(side, "ear"), ear.point(0, 0.95 * e, 0), ear.y());
                break;
            }
        }
        // Eyes bulge a little.
        const Frame eye = skull.moved(0.62 * r * side, 0.3 * r, 0.58 * r);
        solid.ellipsoid(eye, Vec3::Constant(0.21 * r), {0.05 * r});
        figure.landmark(side_name(side, "eye"), eye.origin, eye.direction(0.7 * side, 0.2, 0.65));

        for (const bool front : {true, false}) {
            const double radius = front ? animal.chest : animal.rump;
            const bool forward = front == (side > 0.0);
            const double swing = forward ? animal.stride : -animal.stride;
            const double x = std::max(0.62 * radius * animal.narrow, 1.05 * animal.thigh * 0.8);
            const Frame root =
                trunk.moved(x * side, -0.1 * radius, front ? 0.78 * half : -0.9 * half)
                    .turned_x(-swing - (front ? -4.0 : 8.0))
                    .turned_z(2.5 * side);
            const double length = animal.legs - 0.1 * radius - 0.5 * animal.foot;
            const Frame knee =
                root.moved(0, -0.5 * length, 0)
                    .turned_x(front ? -6 + std::max(0.0, swing) : 20 + 0.5 * std::abs(swing));
            const Frame ankle = knee.moved(0, -0.3 * length, 0).turned_x(front ? 4 : -16);
            const Frame foot = ankle.moved(0, -0.2 * length, 0);
            const double t = animal.thigh;
            solid.sweep({{root.point(0, 0.02, 0), (front ? 1.15 : 1.4) * t},
                         {root.point(0, -0.22 * length, 0), (front ? 0.98 : 1.18) * t},
                         {knee.origin, 0.5 * (animal.shin + 0.8 * t)},
                         {ankle.origin, animal.shin},
                         {foot.origin, animal.shin * 0.95}},
                        {0.09 * (t / 0.1), root.origin, 1.5 * t});
            solid.sweep(
                {{foot.point(0, 0, 0.0), animal.foot},
                 {foot.point(0, -0.1 * animal.foot, 0.55 * animal.foot), 0.95 * animal.foot}},
                {0.04, foot.origin, 0.1}, {Frame{}, {1, 0.8, 1}});
            const std::string leg = front ? "fore" : "hind";
            figure.landmark(side_name(side, (leg + "_shoulder").c_str()), root.origin,
                            trunk.x() * side);
            figure.landmark(side_name(side, (leg + "_knee").c_str()), knee.origin,
                            front ? knee.z() : Vec3(-knee.z()));
            figure.landmark(side_name(side, (leg + "_foot").c_str()),
                            foot.point(0, -0.1 * animal.foot, 0.5 * animal.foot), {0, -0.2, 1});
        }
    }
    figure.detail = 0.018 * (0.6 + 0.4 * animal.length);
    return figure;
}

}  // namespace

ShapeClass quadrupeds()
{
    ShapeClass result{"quadruped", "Four-legged animals", 0, 0, {}, animal_figure};
    for (const Quadruped& animal : kQuadrupeds) {
        result.members.emplace_back(animal.name);
    }
    return result;
}

}  // namespace layout_embedding::shapes
