// The texels of the maps around a translucent body that see it, and which of them the picture looks up: sets of bits, row
// after row in words of 32, map after map. A texel's address is x + (y + map * edge) * edge.

layout(std430, binding = 2) readonly buffer Reads { uint reads[]; };    // in the middle of each 3 x 3 that is looked up
layout(std430, binding = 5) readonly buffer SeeBody { uint see_body[]; };
layout(std430, binding = 6) buffer PassesOf { uint passes_of[]; };      // that each texel has had
uniform uint edge;               // of a map, texels
uniform uint row_words;
uniform uint word_count;
uniform int all_are_read;

ivec3 texel_at(uint address) { return ivec3(address % edge, (address / edge) % edge, address / (edge * edge)); }

uint first_address(uint word) { return word / row_words * edge + word % row_words * 32u; }

// These texels of a row and those beside them.
uint and_beside(uint word, uint in_row)
{
    uint own = reads[word];
    uint before = in_row > 0u ? reads[word - 1u] >> 31 : 0u;
    uint behind = in_row + 1u < row_words ? reads[word + 1u] << 31 : 0u;
    return own | (own << 1) | (own >> 1) | before | behind;
}

// Texels of a word that see the body and stand in a 3 x 3 that is looked up.
uint near_read(uint word)
{
    if (all_are_read != 0) {
        return see_body[word];
    }
    uint in_row = word % row_words;
    uint y = (word / row_words) % edge;
    uint found = and_beside(word, in_row);
    found |= y > 0u ? and_beside(word - row_words, in_row) : 0u;
    found |= y + 1u < edge ? and_beside(word + row_words, in_row) : 0u;
    return found & see_body[word];
}

// Those that stand in the middle of such 3 x 3.
uint middle_of_read(uint word) { return see_body[word] & (all_are_read != 0 ? ~0u : reads[word]); }
