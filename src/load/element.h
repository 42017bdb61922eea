/* The elements' van der Waals radii. */
#ifndef MNS_LOAD_ELEMENT_H
#define MNS_LOAD_ELEMENT_H

#include "load/stream.h"

/* For atoms whose element is not known, in angstroms: about the mean of the common ones. */
#define ELEMENT_UNKNOWN_RADIUS 1.7

/* Radius in angstroms of the element with that symbol, whatever its case; 0 where there is none. */
double element_radius(load_text symbol);

/* The element out of columns 77-78 of a PDB line, else out of the atom's name (columns 13-16), as a literal
 * such as "C"; "X" where neither tells. */
const char *element_of_pdb(load_text symbol, load_text atom_name);

#endif
