#pragma once

#include <cstdint>
#include <vector>

namespace layout_embedding::checker {

/// A reduced word in a free group: letters k and -k (k > 0) are inverse to each other and never
/// neighbours.
using Word = std::vector<std::int32_t>;

/// Multiplies `word` by a letter from the right.
void multiply(Word& word, std::int32_t letter);
/// Multiplies `word` by another from the right; the two may not be the same object.
void multiply(Word& word, const Word& factor);
Word inverse(const Word& word);

/// Whether z = x^a y^b for some integers a and b. Decides exactly; the time is linear in the length
/// of the words where |a| is small, and at worst the product of their lengths.
bool is_product_of_powers(const Word& x, const Word& y, const Word& z);

}  // namespace layout_embedding::checker
