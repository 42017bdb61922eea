/* A comparison that nobody ran: results as results.h has them, with names that try to break out of a page. */
#ifndef MNS_TESTS_PAGE_MADE_UP_H
#define MNS_TESTS_PAGE_MADE_UP_H

#include "compare/pictures.h"

#include <jansson.h>

enum { MADE_UP_RUNS = 7, MADE_UP_WIDTH = 160, MADE_UP_HEIGHT = 120 };

/* A name with a script's end, quotes, an ampersand and letters outside ASCII. */
extern const char MADE_UP_HOSTILE[];

/* Seven runs of three methods, the last one refused, one without any error, and a suite of four cases. A new
 * reference, NULL where memory ends. */
json_t *made_up_results(void);

/* Three pictures a drawn run and the image of the truth, for made_up_free; false: memory ended. The
 * runs' names are borrowed from `results`. */
bool made_up_pictures(const json_t *results, picture_list *list);
void made_up_free(picture_list *list);

#endif
