/* The texts that a page is put together from, generated from web/ and chart.js at build time. */
#ifndef MNS_COMPARE_PAGE_TEXT_H
#define MNS_COMPARE_PAGE_TEXT_H

#include <stddef.h>

typedef struct page_text {
    const char *name; /* "page.html", "page.css", "chart.js" (empty where npm could not fetch it), ... */
    const char *text;
    size_t size;
} page_text;

/* Ends with a NULL name. */
extern const page_text page_texts[];

#endif
