#include "shade/palette.h"

#include <string.h>
#include <strings.h>

/* Anchors of matplotlib's perceptually uniform maps (van der Walt & Smith 2015; cividis: Nunez et al. 2018).
 */
static const struct {
    const char *name;
    uint32_t anchor[PALETTE_ANCHORS];
} maps[MNS_COLOR_MAP_COUNT] = {
    {"viridis",
     {0x440154, 0x482878, 0x3e4989, 0x31688e, 0x26828e, 0x1f9e89, 0x35b779, 0x6ece58, 0xb5de2b, 0xfde725}},
    {"magma",
     {0x000004, 0x180f3d, 0x440f76, 0x721f81, 0x9e2f7f, 0xcd4071, 0xf1605d, 0xfd9668, 0xfeca8d, 0xfcfdbf}},
    {"inferno",
     {0x000004, 0x1b0c41, 0x4a0c6b, 0x781c6d, 0xa52c60, 0xcf4446, 0xed6925, 0xfb9b06, 0xf7d13d, 0xfcffa4}},
    {"plasma",
     {0x0d0887, 0x46039f, 0x7201a8, 0x9c179e, 0xbd3786, 0xd8576b, 0xed7953, 0xfb9f3a, 0xfdca26, 0xf0f921}},
    {"cividis",
     {0x00224e, 0x123570, 0x3b496c, 0x575d6d, 0x707173, 0x8a8678, 0xa59c74, 0xc3b369, 0xe1cc55, 0xfee838}},
};

/* The customary colours of the elements that molecules are made of (Corey, Pauling, Koltun and their
 * followers). */
static const struct {
    const char *symbol;
    uint32_t color;
} elements[] = {
    {"H", 0xf2f2f2},  {"C", 0x909090},  {"N", 0x3050f8},  {"O", 0xff0d0d},  {"F", 0x90e050},
    {"P", 0xff8000},  {"S", 0xffd930},  {"Cl", 0x1ff01f}, {"Br", 0xa62929}, {"I", 0x940094},
    {"Na", 0xab5cf2}, {"Mg", 0x8aff00}, {"K", 0x8f40d4},  {"Ca", 0x3dff00}, {"Mn", 0x9c7ac7},
    {"Fe", 0xe06633}, {"Co", 0xf090a0}, {"Ni", 0x50d050}, {"Cu", 0xc88033}, {"Zn", 0x7d80b0},
    {"Se", 0xffa100}, {"Si", 0xf0c8a0}, {"Al", 0xbfa6a6}, {"Au", 0xffd123}, {"Ag", 0xc0c0c0},
    {"Ti", 0xbfc2c7}, {"He", 0xd9ffff}, {"Ne", 0xb3e3f5}, {"Ar", 0x80d1e3}, {"Li", 0xcc80ff},
};

/* For labels without a custom: neighbours in the cycle differ in hue and lightness (Okabe & Ito 2008, and two
 * more). */
static const uint32_t cycle[] = {0x0072b2, 0xe69f00, 0x009e73, 0xcc79a7, 0x56b4e9,
                                 0xd55e00, 0xf0e442, 0x7f7f7f, 0x8c564b};

static uint32_t to_rgba8(uint32_t color)
{
    return 0xff000000u | (color & 0xff) << 16 | (color & 0xff00) | color >> 16;
}

uint32_t palette_label(const char *label, size_t index, bool element)
{
    for (size_t i = 0; element && i < sizeof elements / sizeof *elements; i++)
        if (strcasecmp(elements[i].symbol, label) == 0) return to_rgba8(elements[i].color);
    return to_rgba8(cycle[index % (sizeof cycle / sizeof *cycle)]);
}

const uint32_t *palette_map(mns_color_map map)
{
    return maps[map].anchor;
}

const char *mns_color_map_name(mns_color_map map)
{
    return (unsigned)map < MNS_COLOR_MAP_COUNT ? maps[map].name : NULL;
}

mns_color_map mns_color_map_by_name(const char *name)
{
    int map = 0;
    while (map < MNS_COLOR_MAP_COUNT && strcmp(maps[map].name, name) != 0) map++;
    return (mns_color_map)map;
}
