"""A place in which strangers' code can do no harm, made of Linux namespaces and limits."""
