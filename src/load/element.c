/* Radii by A. Bondi, J. Phys. Chem. 68 (1964) 441, and for the main-group elements that he leaves out by M.
 * Mantina et al., J. Phys. Chem. A 113 (2009) 5806; the rest by S. Alvarez, Dalton Trans. 42 (2013) 8617. */
#include "load/element.h"

#include <stddef.h>
#include <string.h>
#include <strings.h>

typedef struct element {
    char symbol[3];
    double radius; /* angstroms */
} element;

static const element elements[] = {
    {"H", 1.20},  {"D", 1.20},  {"He", 1.40}, {"Li", 1.82}, {"Be", 1.53}, {"B", 1.92},  {"C", 1.70},
    {"N", 1.55},  {"O", 1.52},  {"F", 1.47},  {"Ne", 1.54}, {"Na", 2.27}, {"Mg", 1.73}, {"Al", 1.84},
    {"Si", 2.10}, {"P", 1.80},  {"S", 1.80},  {"Cl", 1.75}, {"Ar", 1.88}, {"K", 2.75},  {"Ca", 2.31},
    {"Sc", 2.58}, {"Ti", 2.46}, {"V", 2.42},  {"Cr", 2.45}, {"Mn", 2.45}, {"Fe", 2.44}, {"Co", 2.40},
    {"Ni", 1.63}, {"Cu", 1.40}, {"Zn", 1.39}, {"Ga", 1.87}, {"Ge", 2.11}, {"As", 1.85}, {"Se", 1.90},
    {"Br", 1.85}, {"Kr", 2.02}, {"Rb", 3.03}, {"Sr", 2.49}, {"Y", 2.75},  {"Zr", 2.52}, {"Nb", 2.56},
    {"Mo", 2.45}, {"Tc", 2.44}, {"Ru", 2.46}, {"Rh", 2.44}, {"Pd", 1.63}, {"Ag", 1.72}, {"Cd", 1.58},
    {"In", 1.93}, {"Sn", 2.17}, {"Sb", 2.06}, {"Te", 2.06}, {"I", 1.98},  {"Xe", 2.16}, {"Cs", 3.43},
    {"Ba", 2.68}, {"La", 2.98}, {"Ce", 2.88}, {"Pr", 2.92}, {"Nd", 2.95}, {"Sm", 2.90}, {"Eu", 2.87},
    {"Gd", 2.83}, {"Tb", 2.79}, {"Dy", 2.87}, {"Ho", 2.81}, {"Er", 2.83}, {"Tm", 2.79}, {"Yb", 2.80},
    {"Lu", 2.74}, {"Hf", 2.63}, {"Ta", 2.53}, {"W", 2.57},  {"Re", 2.49}, {"Os", 2.48}, {"Ir", 2.41},
    {"Pt", 1.72}, {"Au", 1.66}, {"Hg", 1.55}, {"Tl", 1.96}, {"Pb", 2.02}, {"Bi", 2.07}, {"Po", 1.97},
    {"At", 2.02}, {"Rn", 2.20}, {"Fr", 3.48}, {"Ra", 2.83}, {"Ac", 2.80}, {"Th", 2.93}, {"Pa", 2.88},
    {"U", 1.86},  {"Np", 2.82}, {"Pu", 2.81}, {"Am", 2.83}, {"Cm", 3.05}, {"Bk", 3.40}, {"Cf", 3.05},
    {"Es", 2.70}};

static const element *find(load_text symbol)
{
    size_t length = (size_t)(symbol.end - symbol.at);
    if (length < 1 || length > 2) return NULL;
    for (size_t i = 0; i < sizeof elements / sizeof *elements; i++)
        if (!strncasecmp(elements[i].symbol, symbol.at, length) && !elements[i].symbol[length])
            return &elements[i];
    return NULL;
}

double element_radius(load_text symbol)
{
    const element *found = find(symbol);
    return found ? found->radius : 0;
}

static bool is_letter(char c)
{
    return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z');
}

/* A symbol stands right-aligned in the name's first two columns; a name of four characters may be a
 * hydrogen's that begins a column early ("HG11"). */
static const element *find_in_name(load_text name)
{
    if (name.end - name.at < 2) return NULL;
    const char *c = name.at;
    bool is_full = name.end - c == 4 && c[3] != ' ';
    if (is_letter(c[0]) && is_letter(c[1]) && !(is_full && (*c == 'H' || *c == 'D'))) {
        const element *two = find((load_text){c, c + 2});
        if (two) return two;
    }
    for (; c < name.end; c++)
        if (is_letter(*c)) return find((load_text){c, c + 1});
    return NULL;
}

const char *element_of_pdb(load_text symbol, load_text atom_name)
{
    while (symbol.at < symbol.end && *symbol.at == ' ') symbol.at++;
    while (symbol.at < symbol.end && symbol.end[-1] == ' ') symbol.end--;
    const element *found = find(symbol);
    if (!found) found = find_in_name(atom_name);
    return found ? found->symbol : "X";
}
