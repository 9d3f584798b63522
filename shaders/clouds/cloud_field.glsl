// Density of a layer of clouds after Alaminos 2020, chapter 4 (Häggström 2018, Schneider 2015), made total: finite for
// every weather and every parameter. Points are (x, altitude, z) in metres, x and z from the place whose texture
// coordinates are the origins; those are reduced to one tile in double, so that no time and no place swims.
// Written without branches: every way out that the terms offer is one of their values, and lanes do not wait.
// OVERLAY: the second placement channel joins from a coverage of one half on. FOLLOWS_TOP: density over the cloud's own
// height. LINEAR_COVERAGE: through a table. PACKED: shape noise is one channel.

struct CloudLayer {
    float bottom;             // altitude, m
    float inverse_thickness;  // 1/m
    float coverage;
    float density;
    float erosion;            // most that detail takes away
    vec2 weather_origin;      // tiles
    vec3 shape_origin;
    vec3 detail_origin;
    vec3 scales;              // tiles per metre: weather, shape, detail
    vec2 skew;                // x and z that the top leads by, m
};
uniform CloudLayer layer;
uniform sampler2D weather_map;
uniform sampler3D shape_texture;
uniform sampler3D detail_texture;
#ifdef LINEAR_COVERAGE
uniform sampler1D coverage_table;
#endif

const float least_coverage = 1e-4;
const float least_top = 1.0 / 255.0;

struct CloudColumn {
    float height;    // share of the layer's
    float coverage;  // effective
    float shape;     // profiles over the height
    float density;
    vec3 blown;      // where noise is looked up: leaned with the wind
};

CloudColumn cloud_column(vec3 p)
{
    CloudColumn column;
    float h = clamp((p.y - layer.bottom) * layer.inverse_thickness, 0.0, 1.0);
    vec4 weather = textureLod(weather_map, layer.weather_origin + p.xz * layer.scales.x, 0.0);
#ifdef OVERLAY
    float placed = max(weather.r, 2.0 * clamp(layer.coverage - 0.5, 0.0, 1.0) * weather.g);
#else
    float placed = mix(weather.r, weather.g, layer.coverage);
#endif
    column.coverage = layer.coverage * placed;
#ifdef LINEAR_COVERAGE
    float entries = float(textureSize(coverage_table, 0));
    float share = clamp(column.coverage, 0.0, 1.0);
    column.coverage = share <= least_coverage
                          ? 0.0
                          : textureLod(coverage_table, (share * (entries - 1.0) + 0.5) / entries, 0.0).x;
#endif
    column.height = h;
    float top = max(weather.b, least_top);
    float fall = clamp((h - 0.2 * top) / (0.8 * top), 0.0, 1.0);
    column.shape = weather.b < least_top ? 0.0 : clamp(h / 0.07, 0.0, 1.0) * (1.0 - fall);
#ifdef FOLLOWS_TOP
    float d = clamp(h / top, 0.0, 1.0);
#else
    float d = h;
#endif
    column.density = layer.density * d * clamp(d / 0.15, 0.0, 1.0) * (1.0 - clamp((d - 0.9) / 0.1, 0.0, 1.0)) *
                     weather.a * 2.0;
    column.blown = vec3(p.x - h * layer.skew.x, p.y, p.z - h * layer.skew.y);
    return column;
}

// What of the large shape stands above 1 - coverage, in [0,1].
float cloud_shape(CloudColumn column)
{
    vec4 noise = textureLod(shape_texture, layer.shape_origin + column.blown * layer.scales.y, 0.0);
#ifdef PACKED
    float base = noise.r;
#else
    float octaves = dot(noise.gba, vec3(0.625, 0.25, 0.125));
    float base = (noise.r - (octaves - 1.0)) / (2.0 - octaves);
#endif
    float c = column.coverage;
    return c <= least_coverage ? 0.0 : clamp((base * column.shape - (1.0 - c)) / c, 0.0, 1.0);
}

// `detail` in [0,1] eats from the shape.
float cloud_eroded(CloudColumn column, float shape, float detail)
{
    float eaten = layer.erosion * mix(detail, 1.0 - detail, clamp(5.0 * column.height, 0.0, 1.0));
    return clamp((shape - eaten) / (1.0 - eaten), 0.0, 1.0) * column.density;
}

float cloud_detail(CloudColumn column)
{
    return textureLod(detail_texture, layer.detail_origin + column.blown * layer.scales.z, 0.0).x;
}

float cloud_density(vec3 p)
{
    CloudColumn column = cloud_column(p);
    return cloud_eroded(column, cloud_shape(column), cloud_detail(column));
}

// Never smaller, for one texture less.
float cloud_density_without_detail(vec3 p)
{
    CloudColumn column = cloud_column(p);
    return cloud_shape(column) * column.density;
}
