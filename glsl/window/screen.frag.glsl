// One or two pictures on the window: alone, under a divider, or as the signed difference of their distances.
layout(binding = 0) uniform sampler2D color_a; // linear, premultiplied; sums of samples
layout(binding = 1) uniform sampler2D color_b;
layout(binding = 2) uniform sampler2D t_a;
layout(binding = 3) uniform sampler2D t_b;

layout(location = 0) uniform vec4 frame;  // width and height on the window, place of the divider in pixels, its half width
layout(location = 1) uniform vec4 levels; // gains of A and B, units of distance a t_a and a t_b
layout(location = 2) uniform float scale; // the difference that is shown as full red or blue
layout(location = 4) uniform float square; // side of what stands behind a picture that is not opaque, pixels
layout(location = 3) uniform int mode;    // 0: A, 1: B, 2: A left of the divider and B right of it, 3: difference

layout(location = 0) out vec4 out_color;

// What is not opaque stands before a checkerboard.
vec3 over_squares(vec4 color)
{
    ivec2 at = ivec2(gl_FragCoord.xy / square);
    float light = ((at.x + at.y) & 1) == 0 ? 0.6 : 0.4;
    return color.rgb + (1.0 - clamp(color.a, 0.0, 1.0)) * light;
}

// Red: B is farther; blue: B is nearer; yellow: A alone hits; magenta: B alone.
vec3 difference(vec2 at)
{
    float a = texture(t_a, at).x, b = texture(t_b, at).x;
    if (isinf(a) && isinf(b)) return vec3(0.05);
    if (isinf(b)) return vec3(0.9, 0.7, 0.0);
    if (isinf(a)) return vec3(0.8, 0.0, 0.6);
    float low = texture(t_b, at).y * levels.w - texture(t_a, at).y * levels.z;
    float far = clamp((b * levels.w - a * levels.z + low) / scale, -1.0, 1.0);
    return far > 0.0 ? mix(vec3(0.9), vec3(0.8, 0.0, 0.0), far) : mix(vec3(0.9), vec3(0.0, 0.1, 0.8), -far);
}

void main()
{
    vec2 at = gl_FragCoord.xy / frame.xy;
    bool is_b = mode == 1 || (mode == 2 && gl_FragCoord.x > frame.z);
    vec3 color = mode == 3 ? difference(at)
        : is_b             ? over_squares(texture(color_b, at) * levels.y)
                           : over_squares(texture(color_a, at) * levels.x);
    float beside = abs(gl_FragCoord.x - frame.z);
    if (mode == 2 && beside < frame.w) color = beside < 0.5 * frame.w ? vec3(1.0) : vec3(0.0);
    out_color = vec4(color_srgb(clamp(color, 0.0, 1.0)), 1.0);
}
