/* The options of lights, material and effects, as rows of a table. */
#ifndef MNS_APP_LOOK_OPTIONS_H
#define MNS_APP_LOOK_OPTIONS_H

#include "app/options.h"

option_apply option_shading, option_cel_bands, option_color, option_background, option_color_by,
    option_color_map, option_color_range, option_ambient, option_diffuse, option_specular, option_shininess,
    option_light, option_mesh, option_look, option_shadows, option_reflections, option_refractions,
    option_mirror, option_index, option_transmission, option_absorption, option_occlusion, option_environment,
    option_effects_seed, option_blend_by, option_blend_range, option_blend_color, option_blend_mirror,
    option_blend_transmission, option_blend_absorption;

#define OPTIONS_OF_LOOK                                                                                      \
    {NULL, 0, NULL, "Look:", NULL},                                                                          \
        {"look", 0, "NAME", "plain (the default), clay, water, molecule or glass; other options prevail",    \
         option_look},                                                                                       \
        {"light", 0, "SPEC",                                                                                 \
         "head (at the eye, the default), X,Y,Z (from that direction), point:X,Y,Z or area:X,Y,Z,RADIUS, "   \
         "then "                                                                                             \
         "@STRENGTH or @COLOR or both; may be repeated",                                                     \
         option_light},                                                                                      \
        {"mesh", 0, "FILE[:COLOR]",                                                                          \
         "a solid beside the surface: OBJ, PLY, STL or glTF (default colour 0.8,0.8,0.8); may be repeated",  \
         option_mesh},                                                                                       \
        {"shading", 0, "NAME", "smooth (the default) or cel", option_shading},                               \
        {"cel-bands", 0, "N", "bands of cel shading, 1 to 64 (default 3)", option_cel_bands},                \
        {"color", 0, "COLOR", "the surface, R,G,B in [0, 1] or #rrggbb (default 0.35,0.62,0.86)",            \
         option_color},                                                                                      \
        {"color-by", 0, "NAME", "colour by a column of the input, such as element", option_color_by},        \
        {"color-map", 0, "NAME", "viridis (the default), magma, inferno, plasma or cividis",                 \
         option_color_map},                                                                                  \
        {"color-range", 0, "LO:HI",                                                                          \
         "values at the map's ends (default: the column's, of a sequence those of frame 0)",                 \
         option_color_range},                                                                                \
        {"ambient", 0, "X", "default 0.15", option_ambient},                                                 \
        {"diffuse", 0, "X", "default 0.85", option_diffuse},                                                 \
        {"specular", 0, "X", "default 0.25", option_specular},                                               \
    {                                                                                                        \
        "shininess", 0, "X", "exponent of the highlight (default 40)", option_shininess                      \
    }

#define OPTIONS_OF_EFFECTS                                                                                   \
    {NULL, 0, NULL, "Effects (of every method):", NULL},                                                     \
        {"shadows", 0, "?N", "shadows of all lights but head; N rays a pixel and area light (default 16)",   \
         option_shadows},                                                                                    \
        {"reflections", 0, "N", "mirror levels, 0 (the default) to 8", option_reflections},                  \
        {"refractions", 0, "N", "surfaces that light may pass through, 0 (the default) to 16",               \
         option_refractions},                                                                                \
        {"mirror", 0, "X", "share that is mirrored (default 0.3 with --reflections and no --index, else 0)", \
         option_mirror},                                                                                     \
        {"index", 0, "X", "index of refraction: Fresnel's share is mirrored, and rays are bent",             \
         option_index},                                                                                      \
        {"transmission", 0, "X", "share of the rest that goes through (default 1 with --refractions)",       \
         option_transmission},                                                                               \
        {"absorption", 0, "R,G,B", "Beer's law inside, a scene unit (default 0,0,0)", option_absorption},    \
        {"occlusion", 0, "N[:REACH]",                                                                        \
         "ambient light by N rays (reach by default a tenth of the box's diagonal)", option_occlusion},      \
        {"environment", 0, "sky|FILE", "around the scene: the built-in sky, a map (.exr, .png), or none",    \
         option_environment},                                                                                \
        {"seed", 0, "N", "of the rays for shadows and occlusion (default 0)", option_effects_seed},          \
        {NULL, 0, NULL, "A second material (what is not given is as the first's):", NULL},                   \
        {"blend-by", 0, "NAME", "a column of numbers: how much of it a ball has; or none", option_blend_by}, \
        {"blend-range", 0, "LO:HI", "values of none of it, and of nothing else (default 0:1)",               \
         option_blend_range},                                                                                \
        {"blend-color", 0, "COLOR", "its colour, as of --color", option_blend_color},                        \
        {"blend-mirror", 0, "X", "the share that it mirrors", option_blend_mirror},                          \
        {"blend-transmission", 0, "X", "of the rest, the share that goes through it",                        \
         option_blend_transmission},                                                                         \
    {                                                                                                        \
        "blend-absorption", 0, "R,G,B", "as --absorption", option_blend_absorption                           \
    }

#endif
