#include "embedding/checker_words.hh"

#include <algorithm>

namespace layout_embedding::checker {

void multiply(Word& word, std::int32_t letter)
{
    if (!word.empty() && word.back() == -letter) {
        word.pop_back();
    } else {
        word.push_back(letter);
    }
}

void multiply(Word& word, const Word& factor)
{
    for (const std::int32_t letter : factor) {
        multiply(word, letter);
    }
}

Word inverse(const Word& word)
{
    Word result(word.rbegin(), word.rend());
    for (std::int32_t& letter : result) {
        letter = -letter;
    }
    return result;
}

namespace {

/// How many letters at either end of `word` cancel when it is squared: word = p c p^-1 with c
/// cyclically reduced and p this long.
std::size_t conjugator_length(const Word& word)
{
    std::size_t n = 0;
    while (2 * n + 1 < word.size() && word[n] == -word[word.size() - 1 - n]) {
        ++n;
    }
    return n;
}

/// Whether a word is a power of y, where the word is given backwards.
class PowerTest {
public:
    explicit PowerTest(const Word& y) : y_(y), tail_(conjugator_length(y)) {}

    bool operator()(const Word& reversed) const
    {
        if (reversed.empty()) {
            return true;
        }
        // y = p c p^-1 has powers p c^b p^-1, b of either sign, that do not cancel.
        const std::size_t period = y_.size() - 2 * tail_;
        const std::size_t size = reversed.size();
        if (y_.empty() || size <= 2 * tail_ || (size - 2 * tail_) % period != 0) {
            return false;
        }
        return matches(reversed, y_) || matches(reversed, inverse(y_));
    }

private:
    bool matches(const Word& reversed, const Word& base) const
    {
        const std::size_t size = reversed.size();
        const std::size_t period = base.size() - 2 * tail_;
        for (std::size_t i = 0; i < size; ++i) {
            std::int32_t expected = 0;
            if (i < tail_) {
                expected = base[i];
            } else if (i < size - tail_) {
                expected = base[tail_ + (i - tail_) % period];
            } else {
                expected = base[base.size() - (size - i)];
            }
            if (reversed[size - 1 - i] != expected) {
                return false;
            }
        }
        return true;
    }

    const Word& y_;
    std::size_t tail_;
};

}  // namespace

// Which a have to be tried. The free group acts on its Cayley tree; for a word x = p c p^-1 (c
// cyclically reduced, not empty) let t_x = |c| be the length by which x translates along its axis
// and d_x = |p| the distance of the axis from 1, so |x^a| = 2 d_x + |a| t_x.
//
// Suppose x and y do not commute. Their axes then share less than t_x + t_y (a longer overlap would
// make the commutator fix a point, but the action is free). The geodesics from 1 to x^-a and to y^b
// leave the axes only within d_x and d_y of their ends, so their common part l is at most
// 2 max(d_x, d_y) + t_x + t_y, and
//     |z| = |x^a y^b| = |x^-a| + |y^b| - 2 l >= |a| t_x + |b| t_y - 2 (d_x + d_y) - 2 (t_x + t_y),
// hence |a| <= (|z| + 2 (|x| + |y|)) / t_x.
//
// If they commute, x = r^i and y = r^j (j may be 0), and z has to be some r^k with k = i a + j b.
// For j not 0 some a with 0 <= a < |j| <= |y| will do if any does; for j = 0, |a| t_x <= |z|.
bool is_product_of_powers(const Word& x, const Word& y, const Word& z)
{
    const PowerTest is_power_of_y(y);
    Word forward(z.rbegin(), z.rend());
    if (is_power_of_y(forward)) {
        return true;
    }
    if (x.empty()) {
        return false;
    }
    // forward = reversed x^-a z and backward = reversed x^a z; multiplying from the left is
    // appending to the reversed word.
    Word backward = forward;
    Word forward_step = inverse(x);
    std::reverse(forward_step.begin(), forward_step.end());
    Word backward_step(x.rbegin(), x.rend());
    const std::size_t bound = z.size() + 2 * (x.size() + y.size());
    const std::size_t translation = x.size() - 2 * conjugator_length(x);
    const std::size_t last = std::max(bound / translation, y.size());
    for (std::size_t a = 1; a <= last; ++a) {
        multiply(forward, forward_step);
        multiply(backward, backward_step);
        if (is_power_of_y(forward) || is_power_of_y(backward)) {
            return true;
        }
    }
    return false;
}

}  // namespace layout_embedding::checker
