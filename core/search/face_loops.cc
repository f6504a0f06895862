#include "search/face_loops.hh"

#include <algorithm>

namespace layout_embedding {

namespace {

bool is_power(Words::Letter letter, Words::Letter of)
{
    return letter == of || letter == -of;
}

HomotopyClass inverse(const HomotopyClass& word)
{
    HomotopyClass letters(word.rbegin(), word.rend());
    for (Words::Letter& letter : letters) {
        letter = -letter;
    }
    return letters;
}

}  // namespace

FaceLoops::FaceLoops(const Layout& layout, const PathGraph& graph, const WalkPool& pool,
                     CutSystems& cuts)
    : layout_(layout), graph_(graph), pool_(pool), systems_(cuts)
{}

void FaceLoops::make_cuts()
{
    std::vector<Index> corners;
    for (Index f = 0; f < layout_.face_count(); ++f) {
        corners.clear();
        for (const Index h : layout_.face_halfedges(f)) {
            corners.push_back(layout_.tail(h));
        }
        cuts_.push_back(systems_.away_from(corners));
    }
}

void FaceLoops::add(Index walk)
{
    if (cuts_.empty()) {
        make_cuts();
    }
    words_.resize(std::max<std::size_t>(words_.size(), walk + 1));
    const Index e = pool_.layout_edge(walk);
    for (const Index h : {2 * e, 2 * e + 1}) {
        const Index face = layout_.face(h);
        if (face == kNone || !demands(face)) {
            continue;
        }
        product_.clear();
        for (const Index d : pool_.darts(walk)) {
            cuts_[face]->for_each_crossing(d, [&](Words::Letter letter) { times(letter); });
        }
        const Index side = side_of(h, h % 2 == 0 ? product_ : inverse(product_));
        walks_[side] = walk;
        words_[walk].letters[h % 2] = product_;
        words_[walk].sides[h % 2] = side;
    }
}

/// The id of a class along a halfedge, known or new.
Index FaceLoops::side_of(Index halfedge, Letters letters)
{
    const CutSystem& cuts = *cuts_[layout_.face(halfedge)];
    const Words::Letter own_end = cuts.letter(layout_.head(halfedge));
    while (!letters.empty() && is_power(letters.back(), own_end)) {
        letters.pop_back();
    }
    const Words::Letter own_start = cuts.letter(layout_.tail(halfedge));
    letters.erase(letters.begin(),
                  std::find_if(letters.begin(), letters.end(),
                               [&](Words::Letter letter) { return !is_power(letter, own_start); }));
    const auto [place, is_new] = sides_.try_emplace(std::pair(halfedge, std::move(letters)),
                                                    static_cast<Index>(walks_.size()));
    if (is_new) {
        walks_.push_back(kNone);
    }
    return place->second;
}

void FaceLoops::times(Words::Letter letter)
{
    if (!product_.empty() && product_.back() == -letter) {
        product_.pop_back();
    } else {
        product_.push_back(letter);
    }
}

void FaceLoops::go_along(Index halfedge, Index walk)
{
    const Letters& word = words_[walk].letters[halfedge % 2];
    if (halfedge % 2 == 0) {
        for (const Words::Letter letter : word) {
            times(letter);
        }
    } else {
        for (std::size_t i = word.size(); i-- > 0;) {
            times(-word[i]);
        }
    }
}

/// Turns from the walk at a place to the next one: inside the face, clockwise around their landmark
/// from where the one arrives to where the other leaves, perhaps across the landmark's own arc.
void FaceLoops::turn(Index face, std::span<const Index> walks, std::size_t place)
{
    const auto halfedges = layout_.face_halfedges(face);
    const std::size_t next = (place + 1) % halfedges.size();
    const Index from = Layout::twin(halfedges[place]);
    const Index to = halfedges[next];
    const Index v = layout_.tail(to);
    const Words::Letter letter = cuts_[face]->letter(v);
    if (letter == 0) {
        return;  // a landmark on the boundary, without an arc
    }
    const auto is_before_arc = [&](Index h, Index walk) {
        const auto& darts = pool_.darts(walk);
        return (h % 2 == 0 ? darts.front() : graph_.twin(darts.back())) <=
               cuts_[face]->first_dart(v);
    };
    const bool from_is_before = is_before_arc(from, walks[place]);
    const bool to_is_before = is_before_arc(to, walks[next]);
    // Counted from the landmark's first dart; the turn may pass that.
    const bool passes_first = pool_.place(from, walks[place]) < pool_.place(to, walks[next]);
    if (passes_first ? to_is_before || !from_is_before : to_is_before && !from_is_before) {
        times(-letter);
    }
}

bool FaceLoops::closes(Index face, std::span<const Index> walks)
{
    const auto halfedges = layout_.face_halfedges(face);
    product_.clear();
    for (std::size_t i = 0; i < halfedges.size(); ++i) {
        go_along(halfedges[i], walks[i]);
        turn(face, walks, i);
    }
    return product_.empty();
}

Index FaceLoops::completion(Index face, std::span<const Index> walks, std::size_t place)
{
    const auto halfedges = layout_.face_halfedges(face);
    product_.clear();
    for (std::size_t i = place + 1; i < place + halfedges.size(); ++i) {
        go_along(halfedges[i % halfedges.size()], walks[i % halfedges.size()]);
        if (i + 1 < place + halfedges.size()) {
            turn(face, walks, i % halfedges.size());
        }
    }
    return side_of(halfedges[place], inverse(product_));
}

}  // namespace layout_embedding
