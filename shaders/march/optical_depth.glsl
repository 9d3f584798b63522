// Opacity of a segment from its optical depth, accurate for thin and thick ones.
// Below 1e-3 the difference 1 - exp(-tau) would lose its digits, so a series takes over (relative error < tau^3 / 24).
float opacity_of(float tau)
{
    return tau < 1e-3 ? tau * (1.0 - 0.5 * tau * (1.0 - tau * (1.0 / 3.0))) : 1.0 - exp(-tau);
}
