// Vases (hollow, with four ribs) and cups (hollow, with a handle to the left: genus 1). They stand
// along y, open above.

#include <array>

#include "shapes/classes/classes.hh"

namespace layout_embedding::shapes {

namespace {

struct Vase {
    const char* name;
    /// Radii and heights of foot, belly, neck and lip.
    double foot;
    double belly;
    double belly_height;
    double neck;
    double neck_height;
    double lip;
    double height;
    double wall;
    /// Radius of the knobs on the belly, and of the ribs below them; the ribs wind by so many
    /// degrees.
    double knob;
    double rib;
    double wind;
};

const std::array<Vase, 9> kVases{{
    {"amphora", 0.24, 0.55, 0.85, 0.2, 1.5, 0.32, 1.8, 0.08, 0.1, 0.04, 0},
    {"bowl", 0.38, 0.72, 0.4, 0.82, 0.62, 0.88, 0.8, 0.08, 0.09, 0.04, 0},
    {"bottle", 0.4, 0.48, 0.5, 0.15, 1.3, 0.2, 1.9, 0.07, 0.08, 0.035, 30},
    {"tulip", 0.26, 0.5, 0.55, 0.36, 1.1, 0.66, 1.6, 0.08, 0.1, 0.05, 50},
    {"jar", 0.42, 0.62, 0.6, 0.5, 1.05, 0.56, 1.2, 0.08, 0.12, 0.05, 0},
    {"slender", 0.26, 0.36, 1.2, 0.2, 1.9, 0.32, 2.3, 0.07, 0.07, 0.035, 80},
    {"urn", 0.36, 0.68, 0.9, 0.44, 1.35, 0.54, 1.6, 0.08, 0.13, 0.06, -24},
    {"flask", 0.5, 0.72, 0.42, 0.16, 1.15, 0.26, 1.4, 0.08, 0.1, 0.04, 0},
    {"goblet", 0.3, 0.5, 0.95, 0.42, 1.3, 0.52, 1.5, 0.08, 0.08, 0.03, -40},
}};

/// The profile of a hollow vessel: the outer curve up, a round lip, the inner curve down.
Profile hollow(const Profile& outer, double wall, double bottom)
{
    Profile profile = smooth_curve(outer, 8);
    const std::size_t count = profile.size();
    // Points at distance `wall` inwards, down to the bottom.
    Profile inner;
    for (std::size_t i = count; i-- > 1;) {
        const double dx = profile[i][0] - profile[i - 1][0];
        const double dy = profile[i][1] - profile[i - 1][1];
        const double length = std::sqrt(dx * dx + dy * dy);
        const double x = profile[i][0] - wall * dy / length;
        const double y = profile[i][1] + wall * dx / length;
        if (y > bottom && x > 0.02 && (inner.empty() || y < inner.back()[1])) {
            inner.push_back({x, y});
        }
    }
    profile.insert(profile.begin(), {0.0, outer[0][1]});
    profile.insert(profile.end(), inner.begin(), inner.end());
    profile.push_back({std::max(0.6 * inner.back()[0], 0.05), bottom});
    profile.push_back({0.0, bottom});
    return profile;
}

/// How far from the axis a round solid ends at height y.
double outer_radius(const Solid& solid, double y)
{
    double x = 1.5;
    while (x > 0.02 && solid.distance({x, y, 0}) > 0.0) {
        x -= 0.01;
    }
    return x;
}

Figure vase_figure(Index member)
{
    const Vase& vase = kVases[member];
    Figure figure;
    Solid& solid = figure.solid;
    const Frame upright;
    const double e = 0.5 * vase.wall;
    const double bottom = 0.14;
    const Profile outer{{vase.foot, 0.0},
                        {0.97 * vase.foot, 0.12},
                        {vase.belly, vase.belly_height},
                        {vase.neck, vase.neck_height},
                        {vase.lip, vase.height}};
    solid.revolution(upright, hollow(outer, vase.wall, bottom), e, {});
    // Without the ribs that are about to be added.
    const Solid wall = solid;
    std::array<Vec3, 4> knobs;
    for (int i = 0; i < 4; ++i) {
        std::vector<Knot> rib;
        for (int k = 0; k <= 4; ++k) {
            const double t = 0.25 * k;
            const double y = 0.1 + t * (vase.belly_height - 0.1);
            const Frame turned = upright.turned_y(90.0 * i + vase.wind * t);
            rib.push_back(
                {turned.point(0, y, outer_radius(wall, y)), vase.rib * (0.5 + 0.5 * t) + 0.012});
        }
        knobs[i] = rib.back().position;
        solid.sweep(rib, {0.05}, {}, 3);
        solid.ellipsoid({knobs[i], upright.axes}, Vec3::Constant(vase.knob), {0.08});
    }
    for (int i = 0; i < 4; ++i) {
        const std::string number = std::to_string(i + 1);
        const Frame turned = upright.turned_y(90.0 * i + vase.wind);
        figure.landmark("knob_" + number, knobs[i], turned.z());
        const Frame foot = upright.turned_y(90.0 * i);
        figure.landmark("foot_" + number, foot.point(0, 0.03, 0), foot.z());
        // From the middle of the wall at the lip.
        const Frame lip = upright.turned_y(90.0 * i);
        figure.landmark("lip_" + number,
                        lip.point(0, vase.height - 0.3 * e, vase.lip - 0.5 * vase.wall), lip.y());
    }
    figure.landmark("inner_bottom", upright.point(0, 0.07, 0), upright.y());
    figure.landmark("outer_bottom", upright.point(0, 0.07, 0), -upright.y());
    figure.detail = 0.024;
    return figure;
}

struct Cup {
    const char* name;
    double foot;
    double belly;
    double lip;
    double height;
    double wall;
    /// The handle: upper and lower height as parts of the height, reach, radius, flatness.
    double upper;
    double lower;
    double reach;
    double radius;
};

const std::array<Cup, 8> kCups{{
    {"mug", 0.46, 0.47, 0.47, 1.0, 0.07, 0.8, 0.2, 0.36, 0.065},
    {"tea_cup", 0.28, 0.56, 0.66, 0.66, 0.055, 0.82, 0.32, 0.3, 0.05},
    {"espresso", 0.3, 0.42, 0.44, 0.6, 0.07, 0.78, 0.3, 0.22, 0.05},
    {"stein", 0.5, 0.48, 0.42, 1.3, 0.08, 0.82, 0.2, 0.42, 0.08},
    {"bowl_cup", 0.36, 0.72, 0.74, 0.7, 0.07, 0.74, 0.36, 0.3, 0.07},
    {"pitcher", 0.42, 0.6, 0.4, 1.5, 0.07, 0.84, 0.3, 0.5, 0.07},
    {"pot_belly", 0.34, 0.62, 0.46, 0.95, 0.07, 0.84, 0.28, 0.34, 0.06},
    {"beaker", 0.34, 0.42, 0.54, 1.2, 0.06, 0.76, 0.3, 0.34, 0.055},
}};

Figure cup_figure(Index member)
{
    const Cup& cup = kCups[member];
    Figure figure;
    Solid& solid = figure.solid;
    const Frame upright;
    const double e = 0.5 * cup.wall;
    const double h = cup.height;
    solid.revolution(upright,
                     hollow({{cup.foot, 0.0},
                             {0.5 * (cup.foot + cup.belly), 0.1 * h},
                             {cup.belly, 0.45 * h},
                             {cup.lip, h}},
                            cup.wall, 0.13),
                     e, {});
    const double yu = cup.upper * h;
    const double yl = cup.lower * h;
    const double xu = outer_radius(solid, yu);
    const double xl = outer_radius(solid, yl);
    const double far = std::max(xu, xl) + cup.reach;
    const double r = cup.radius;
    const Vec3 top(far - 0.3 * cup.reach, yu + 0.03, 0);
    const Vec3 middle(far, 0.55 * yu + 0.45 * yl, 0);
    const Vec3 low(far - 0.36 * cup.reach, yl + 0.06 * h, 0);
    solid.sweep({{{xu - 0.02, yu, 0}, 1.1 * r},
                 {top, 0.95 * r},
                 {middle, r},
                 {low, 0.95 * r},
                 {{xl - 0.02, yl, 0}, 1.1 * r}},
                {0.07}, {upright, {1, 1, 1.25}}, 8);
    figure.landmark("handle_top", top, {0.5, 1, 0});
    figure.landmark("handle_middle", middle, {1, 0, 0});
    figure.landmark("handle_low", low, {0.7, -1, 0});
    figure.landmark("handle_inner", middle, {-1, 0, 0});
    for (int i = 0; i < 4; ++i) {
        const Frame turned = upright.turned_y(90.0 * i);
        const std::string number = std::to_string(i + 1);
        figure.landmark("lip_" + number, turned.point(cup.lip - 0.5 * cup.wall, h - 0.3 * e, 0),
                        turned.y());
        figure.landmark("foot_" + number, turned.point(0, 0.04, 0), turned.x());
    }
    for (int i = 1; i < 4; ++i) {
        const Frame turned = upright.turned_y(90.0 * i);
        figure.landmark("belly_" + std::to_string(i + 1),
                        turned.point(cup.belly - 0.5 * cup.wall, 0.45 * h, 0), turned.x());
    }
    figure.landmark("inner_bottom", {0, 0.06, 0}, {0, 1, 0});
    figure.landmark("outer_bottom", {0, 0.06, 0}, {0, -1, 0});
    figure.detail = 0.024;
    return figure;
}

}  // namespace

ShapeClass vases()
{
    ShapeClass result{"vase", "Vases", 0, 0, {}, vase_figure};
    for (const Vase& vase : kVases) {
        result.members.emplace_back(vase.name);
    }
    return result;
}

ShapeClass cups()
{
    ShapeClass result{"cup", "Cups", 1, 0, {}, cup_figure};
    for (const Cup& cup : kCups) {
        result.members.emplace_back(cup.name);
    }
    return result;
}

}  // namespace layout_embedding::shapes
