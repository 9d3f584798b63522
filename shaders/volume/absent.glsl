// Samples that are absent (HOLES: some are) have texels of -1e36: whatever is interpolated with one of them lies below this,
// and is as absent as they are. No other texel is below -1e7.
bool is_absent(float texel) { return texel < -1e14; }
// Takes the place of a coordinate in a table, or of u, where nothing is.
const float coordinate_of_absent = -3e38;
bool is_absent_coordinate(float x) { return x < -1e38; }
