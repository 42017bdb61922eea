/* Keeps the support library from being empty. */
extern int test_support_anchor;
int test_support_anchor = 0;
