#include "embedding/straightening.hh"

#include <algorithm>
#include <utility>

#include "embedding/angle_widening.hh"

namespace layout_embedding {

namespace {

/// As in StraighteningOptions::spacing, while strands get out of each other's way.
constexpr double kTinySpacing = 1e-3;
/// A strand has moved if it became shorter by this share.
constexpr double kLeastMove = 1e-7;
/// Sweeps end when the total length sinks by less than this share.
constexpr double kLeastSweep = 1e-5;
constexpr int kMostSweeps = 100;
/// Never met; so many passes over each strand, on average, end the first stage.
constexpr std::uint64_t kMostPasses = 5000;
/// The share of all the work that the first stage is said to be.
constexpr double kFirstStage = 0.6;

}  // namespace

Straightening::Straightening(NormalForm form, const std::vector<Index>& landmarks,
                             StraighteningOptions options)
    : angles_(form.mesh()),
      gaps_(options.spacing, options.open_angles ? &angles_ : nullptr),
      options_(options),
      original_(std::move(form)),
      original_length_(original_.total_length()),
      form_(original_),
      moves_(form_, landmarks, options.edge_costs),
      waiting_(form_.strand_count(), true),
      waiting_count_(form_.strand_count())
{}

bool Straightening::step()
{
    switch (stage_) {
        case Stage::tiny_gaps:
            tighten_next();
            break;
        case Stage::strands:
            sweep_strand();
            break;
        case Stage::edges:
            balance_edges();
            break;
        case Stage::done:
            break;
    }
    return stage_ != Stage::done;
}

void Straightening::tighten_next()
{
    if (waiting_count_ == 0 || passes_ > kMostPasses * form_.strand_count()) {
        open_gaps();
        return;
    }
    while (!waiting_[current_]) {
        current_ = (current_ + 1) % form_.strand_count();
    }
    ++passes_;
    const Index strand = current_;
    if (turn_length_ < 0) {
        turn_length_ = form_.length(strand);
    }
    tightening_.tighten(form_, strand, CrossingGaps(kTinySpacing));
    bool moved = false;
    for (Index id = form_.element(form_.first(strand)).next; form_.element(id).next != kNone;
         id = form_.element(id).next) {
        if (form_.element(id).is_crossing()) {
            const Index snapped = moves_.snap(id);
            if (snapped == kNone) {
                continue;
            }
            id = snapped;
            moved = true;
        }
        const Index vertex = form_.element(id).vertex;
        if (const Index before = moves_.pop(id, kTinySpacing); before != kNone) {
            moved = true;
            // What lay behind the strand may follow it.
            mark_around(vertex);
            id = before;
        }
    }
    if (moved) {
        return;  // and goes on with this strand
    }
    waiting_[strand] = false;
    --waiting_count_;
    if (form_.length(strand) < turn_length_ * (1 - kLeastMove)) {
        mark_neighbours(strand);
    }
    turn_length_ = -1;
    current_ = (current_ + 1) % form_.strand_count();
    progress_ = std::max(
        progress_, kFirstStage * (1 - static_cast<double>(waiting_count_) / form_.strand_count()));
}

void Straightening::mark(Index strand)
{
    if (!waiting_[strand] && strand != current_) {
        waiting_[strand] = true;
        ++waiting_count_;
    }
}

void Straightening::mark_neighbours(Index strand)
{
    for (Index id = form_.first(strand); id != kNone; id = form_.element(id).next) {
        const NormalForm::Element& x = form_.element(id);
        if (!x.is_crossing()) {
            continue;
        }
        for (const bool towards_tail : {true, false}) {
            const Index beside = towards_tail ? x.edge_previous : x.edge_next;
            const Index other =
                beside != kNone ? beside : moves_.carried(moves_.vertex_beside(id, towards_tail));
            if (other != kNone) {
                mark(form_.element(other).strand);
            }
        }
    }
}

void Straightening::mark_around(Index vertex)
{
    const TriangleMesh& mesh = form_.mesh();
    const Index start = mesh.outgoing(vertex);
    Index h = start;
    do {
        const Index edge = mesh.edge(h);
        const Index beside =
            mesh.halfedge(edge) == h ? form_.first_on_edge(edge) : form_.last_on_edge(edge);
        if (beside != kNone) {
            mark(form_.element(beside).strand);
        }
        h = mesh.rotated_ccw(h);
    } while (h != start);
}

void Straightening::open_gaps()
{
    if (options_.open_angles) {
        relieve_fans(form_, moves_, angles_);
    }
    keep_gaps(form_, gaps_);
    progress_ = std::max(progress_, kFirstStage);
    begin_sweep();
}

void Straightening::begin_sweep()
{
    gaps_.prepare(form_);
    crowded_.clear();
    for (Index id = 0; id < form_.element_count(); ++id) {
        const NormalForm::Element& x = form_.element(id);
        if (x.is_crossing() && x.edge_previous == kNone && x.edge_next != kNone) {
            crowded_.push_back(form_.edge(id));
        }
    }
    sweep_length_ = form_.total_length();
    current_ = 0;
    stage_ = Stage::strands;
}

void Straightening::sweep_strand()
{
    tightening_.tighten(form_, current_, gaps_);
    if (++current_ == form_.strand_count()) {
        stage_ = Stage::edges;
    }
}

void Straightening::balance_edges()
{
    for (const Index edge : crowded_) {
        balancing_.balance(form_, edge, gaps_);
    }
    ++sweeps_;
    progress_ = std::max(progress_, 1 - (1 - kFirstStage) * 4 / (4.0 + sweeps_));
    const bool settled = !(form_.total_length() < sweep_length_ * (1 - kLeastSweep));
    if (sweeps_ >= kMostSweeps || (settled && (fixed_ || !snap_strands()))) {
        conclude();
    } else {
        begin_sweep();
    }
}

bool Straightening::snap_strands()
{
    bool snapped = false;
    for (Index strand = 0; strand < form_.strand_count(); ++strand) {
        for (Index id = form_.element(form_.first(strand)).next; form_.element(id).next != kNone;
             id = form_.element(id).next) {
            if (!form_.element(id).is_crossing()) {
                continue;
            }
            if (const Index vertex = moves_.snap(id); vertex != kNone) {
                id = vertex;
                snapped = true;
            }
        }
    }
    if (snapped) {
        // Fewer crossings on an edge keep wider gaps.
        keep_gaps(form_, gaps_);
    }
    return snapped;
}

void Straightening::conclude()
{
    if (!fixed_ && form_.total_length() > original_length_) {
        // There is no room for what was gained: shorten without leaving the original's sleeves,
        // where every step is one forward.
        form_ = std::move(original_);
        gaps_ = CrossingGaps(options_.spacing);
        fixed_ = true;
        sweeps_ = 0;
        begin_sweep();
        return;
    }
    if (options_.open_angles) {
        widen_angles(form_, angles_, options_.spacing, original_length_);
    }
    form_.compact();
    progress_ = 1;
    stage_ = Stage::done;
}

void Straightening::finish()
{
    if (stage_ == Stage::done) {
        return;
    }
    keep_gaps(form_, gaps_);
    if (form_.total_length() > original_length_ && !fixed_) {
        form_ = std::move(original_);
    }
    form_.compact();
    progress_ = 1;
    stage_ = Stage::done;
}

NormalForm Straightening::take()
{
    return std::move(form_);
}

}  // namespace layout_embedding
