"""The numbers on these pages that are values of the lab's stored tables: see scripts/lab_numbers.py."""
# ruff: noqa: F821
SEQUENCES = ("lcg", "icg", "halton", "faure", "sobol")
SCENES = {"cube": "cube", "living-room": "living room", "office": "office", "teapot": "teapot"}

# --- Keller 1994
page = "keller-1994.md"
for table, words in (("1", "paths for epsilon"), ("2", "deviation from the analytic answer"), ("3", "the same weighted by area")):
    _, agree, within, differ = verdicts(f"keller-1994-table{table}")
    line(page, f"| table {table}: {words} | {agree} of 60 agree, {within} more within 1.5, {differ} differ")
for scene, name in SCENES.items():
    where = {"scene": scene, "epsilon": 1e-4}
    t = "keller-1994-table1"
    line(page, f"| 1, {name} | " + " | ".join(
        f"{value(t, 'paths', 1e-3, sequence=s, **where)} ({value(t, 'published', 1e-3, sequence=s, **where)})" for s in SEQUENCES) + " |")
    for table in ("2", "3"):
        t = f"keller-1994-table{table}"
        line(page, f"| {table}, {name} | " + " | ".join(
            f"{value(t, 'rms', scene=scene, N=1e5, sequence=s)} ({value(t, 'published', scene=scene, N=1e5, sequence=s)})"
            for s in SEQUENCES) + " |")
t = "keller-1994-figure1"
off = [value(t, "mean_off_percent", scene=s) for s in ("living-room", "office", "teapot")]
line(page, f"means {off[0]}, {off[1]} and {off[2]} % from path tracing")


def feature(begin, name, setting, saved=True):
    form = "{rays_per_pixel} | {rmse} ({rmse_low}-{rmse_high}) | {saved_rays}" + (" ({saved_low}-{saved_high})" if saved else "")
    line(page, f"| {begin} | {cell('keller-1994-features', form, feature=name, setting=setting)} |")


feature("light sources, living room | all 368 at each of 16 points", "permuted lights", "all lights", False)
feature("`light_sampling=permuted`", "permuted lights", "permuted")
feature("neighbours, office | separate samples", "sharing in a coarse image", "separate samples", False)
feature("the same, 128 x 96 | `share_neighbours=true`", "neighbour sharing", "shared")
feature("oversampling, office | 16 Halton points", "oversampling", "16 Halton points", False)
feature("64 Halton points", "oversampling", "64 Halton points")
feature("adaptive to .01, at most 64", "oversampling", "adaptive to .01")
t = "keller-1994-mirrors"
line(page, "next to a mirror wall the deviation is {} / {} / {} at N = 1e3 / 1e4 / 1e5, without the mirror {} / {} / {}".format(
    *(value(t, "deviation", far_wall=w, N=n) for w in ("mirror", "like the others") for n in (1e3, 1e4, 1e5))))
t = "keller-1994-boxes/fits"
for box, name in (("cube", "cube"), ("1 x 1 x 26", "1 x 1 x 26"), ("5 x 4 x .05", "5 x 4 x .05")):
    line(page, f"| {name} | 2, 3 | " + " | ".join(
        f"{value(t, 'table_2', box=box, faure=f)}, {value(t, 'table_3', box=box, faure=f)}"
        for f in ("faure", "faure scrambled", "faure from 67^2 - 1", "faure from 67^3 - 1")) + " |")
t = "keller-1994-floor"
for scene, name in (("office", "office"), ("living-room", "living room")):
    block = []
    for begin, cause, column in ((f"{name} | published", "open", "published"), ("| opened", "open", "rms"),
                                 ("| outer faces", "outer faces", "rms"), ("| unlit faces", "unlit", "rms")):
        fits = note(t, f"{scene}, {cause}: within a factor of 1.5 of (\\d+) of 15 values of table 2 and (\\d+) of table 3")
        shown = [f" {fit} " if column == "rms" else " " for fit in fits]
        sizes = [" / ".join(value(t, column, scene=scene, cause=cause, sequence="halton", table=k, N=n) for n in (1e3, 1e4, 1e5))
                 for k in (2, 3)]
        block.append(f"| {begin} | {sizes[0]} |{shown[0]}| {sizes[1]} |{shown[1]}|")
    line(page, "\n".join(block))

# --- Marques 2013
page = "marques-2013.md"
t = "marques-2013-table1"
_, agree, within, differ = verdicts(t)
line(page, f"{agree} of 36 published ratios agree, {within} more are within 10 %, {differ} differ")
for scene in ("cornell-box", "room", "cars"):
    for component in ("glossy", "diffuse"):
        for map_ in ("lambert", "concentric"):
            line(page, f"| {scene}, {component}, {map_} | " + " | ".join(
                cell(t, "{ratio} ({published_ratio})", pattern=s, scene=scene, component=component, map=map_)
                for s in ("sobol", "bnot", "larcher-pillichshammer")) + " |")
above = len(rows(t, ratio_low=lambda text: text != "" and float(text) > 1))
line(page, f"Of the 36 intervals {put(above)} are above 1")
t = "marques-2013-gather"
for n in (16, 64, 256, 512):
    line(page, f"| {n} | " + " | ".join(
        cell(t, "{ratio_low} to {ratio_high}", component=c, pattern="sobol", directions=n) for c in ("diffuse", "glossy")) + " |")
line(page, f"which no pattern changes, is {note(t, r'mean (-?[0-9.]+) %')[0]} % of the mean")
t = "marques-2013-fig1"
for n in (64, 128, 256):
    line(page, f"| {n} | " + " | ".join(
        cell(t, "{ratio} [{low}, {high}]", quantity=q, directions=n) for q in ("rmse", "largest quadratic error")) + " |")
t = "marques-2013-fig3/slopes"
for name, set_, map_ in (("spherical Fibonacci", "spherical-fibonacci", "-"), ("Larcher-Pillichshammer, lambert", "larcher-pillichshammer", "lambert"),
                         ("BNOT, lambert", "bnot", "lambert"), ("BNOT, concentric", "bnot", "concentric"), ("Sobol, lambert", "sobol", "lambert")):
    line(page, f"| {name} | " + " | ".join(
        cell(t, "{energy_slope} [{low}, {high}]", domain=d, set=set_, map=map_) for d in ("hemisphere", "sphere")) + " |")
t = "marques-2013-fig4/slopes"
for scene, component in (("cornell-box", "glossy"), ("cornell-box", "diffuse"), ("room", "glossy"), ("cars", "glossy")):
    line(page, f"| {scene}, {component} | {cell(t, '{slope} [{low}, {high}]', scene=scene, component=component, pattern='spherical-fibonacci')} |")
t = "aureole-correlated-rotations"
BLURS = ("pixels", "mean of 4 x 4", "Gaussian 1", "Gaussian 2")
for n in (16, 64):
    line(page, "\n".join(f"| {begin} | `{form}` | " + " | ".join(
        cell(t, "{ratio} [{ratio_low}, {ratio_high}]", pattern="spherical-fibonacci", directions=n, rotations=form, blur=b) for b in BLURS) + " |"
        for begin, form in ((n, "blue"), ("", "none"))).replace("|  |", "| |"))
less = [100 * (1 - float(row["ratio"])) for row in rows(t, rotations="blue", blur=lambda text: text != "pixels")
        if row["directions"] == "16" or row["pattern"] == "sobol"]
more = [100 * (float(row["ratio"]) - 1) for row in rows(t, rotations="blue", directions=64, pattern="spherical-fibonacci", blur=lambda text: text != "pixels")]
sf = [100 * (1 - float(row["ratio"])) for row in rows(t, rotations="blue", directions=16, pattern="spherical-fibonacci", blur=lambda text: text != "pixels")]
line(page, f"saves {put(min(sf))} to {put(max(sf))} % after a blur at 16 directions; at 64 loses {put(min(more))} to {put(max(more))} %")

# --- finalgather-lab
page = "gathering.md"
line(page, f"{put(min(less))} to {put(max(less))} % less than `random`, but for 64 directions of spherical Fibonacci points, where it has "
           f"{put(min(more))} to {put(max(more))} % more")
for set_, name in (("spherical-fibonacci", "spherical Fibonacci"), ("sobol", "Sobol")):
    for n in (16, 64):
        line(page, "\n".join(f"| {begin} | `{form}` | " + " | ".join(
            cell(t, "{rmse_percent}", pattern=set_, directions=n, rotations=form, blur=b) for b in BLURS) + " |"
            for begin, form in ((f"{name}, {n}", "random"), ("", "blue"), ("", "none"))).replace("|  |", "| |"))

# --- Marques 2018
page = "marques-2018.md"
t = "marques-2018-gains"
gain = {f: cell(t, "{mean} +- {spread}", set="sobol", figure=f"OSW {f}") for f in ("diffuse", "glossy")}
line(page, f"agrees: {gain['diffuse']} and {gain['glossy']} %")
line(page, f"1.03: {value(t, 'mean', set='sobol', figure='OSWA against OSW')} and {value(t, 'mean', set='sobol', figure='OSWA against QMC')} %")
more = {k: [value(t, "mean", set=k, figure=f"OSW {f}") for f in ("diffuse", "glossy")] for k in ("pmj02", "cascaded")}
line(page, "{} to {} % (pmj02), {} to {} % (cascaded Sobol".format(*more["pmj02"], *more["cascaded"]))
t = "marques-2018-fig7"
slope = {q: value(t, "measured", quantity=f"slope, {q}") for q in ("random QMC", "random MIS", "random OSW", "random OSWA", "sobol QMC", "sobol OSW")}
line(page, f"agrees ({slope['random QMC']}, {slope['random MIS']}); steeper than published ({slope['random OSW']}, {slope['random OSWA']})")
line(page, f"holds: {slope['sobol QMC']} and {slope['sobol OSW']}; RMSE times {note(t, 'sobol: OSW .* RMSE times ([0-9.]+)')[0]} to "
           f"{note(t, 'sobol: OSW .* and ([0-9.]+) ')[0]}")
for begin, what in (("a factor of 1.08:", "QMC for the error of OSW"), ("a factor of 1.16:", "MIS for the error of OSWA")):
    line(page, f"{begin} {cell(t, '{measured} ({low} to {high})', quantity=f'samples of {what} with 768, sobol')} |")
t = "marques-2018-rivals"
METHODS = ("MIS balance", "optimal MIS", "regression of degree 2", "OSW", "OSWA as published", "OSWA", "OSWA, clipped",
           "OSWA, clipped, optimal density")
for name, set_, light, degrees in (("Sobol, smooth, 0 degrees", "sobol", "smooth", 0), ("Sobol, smooth, 75", "sobol", "smooth", 75),
                                   ("Sobol, hard edges, 60", "sobol", "hard edges", 60),
                                   ("spherical Fibonacci, smooth, 0", "spherical-fibonacci", "smooth", 0), ("random, smooth, 0", "random", "smooth", 0)):
    line(page, f"| {name} | " + " | ".join(
        value(t, "relative_to_equal", set=set_, light=light, degrees=degrees, method=m) for m in METHODS) + " |")
controls = {}
for row in rows(t):
    controls.setdefault((row["set"], row["light"], row["degrees"]), {})[row["method"]] = float(row["rmse"])
below = sum(of["OSWA, clipped"] < min(of["optimal MIS"], of["regression of degree 2"]) for of in controls.values())
line(page, f"is below both in {put(below)} of {put(len(controls))} cases")
t = "marques-2018-table1"
_, agree, _, differ = verdicts(t)
line(page, f"{agree} of 9 published values agree, {differ} differ")
for begin, scene, set_, ends in (
        ("box, 40 + 20 | random", "Cornell box", "random", (" [1.67]", " [1.47]", " [1.85]")),
        ("| Sobol", "Cornell box", "sobol", (" [1.15]", " [1.43]", " [1.58]")),
        ("figure in the studio, 50 + 25 | random", "figure in the studio", "random", ("", "", "")),
        ("| Sobol", "figure in the studio", "sobol", (" [1.075]", " [1.09]", " [1.19]")),
        ("| spherical Fibonacci", "figure in the studio", "spherical-fibonacci", ("", "", ""))):
    line(page, f"| {begin} | " + " | ".join(
        cell(t, "{over_oswa} ({over_low}..{over_high})", scene=scene, set=set_, weights=w) + end
        for w, end in zip(("OSWA as published", "MIS", "OSW", "equal"), ("", *ends))) + " |")
t = "marques-2018-box"
of = {s: [value(t, "over_oswa", exponent=5, share=0.8, set=s, weights=w) for w in ("MIS", "OSW", "equal")] for s in ("sobol", "random")}
line(page, f"have {', '.join(of['sobol'])}\n  (Sobol) and {', '.join(of['random'])} (random)")
most = max(float(row["over_oswa"]) for row in rows(t, set="random", weights="MIS"))
line(page, f"has {put(most)} at most on average")
line(page, "one set has " + cell(t, "{set_low} to {set_high}", exponent=5, share=0.8, set="random", weights="MIS"))
t = "marques-2018-lobes"
merged = {light: [float(row["over_plain"]) for row in rows(t, light=light, method="OSWA")] for light in ("smooth", "hard edges")}
line(page, f"RMSE {put(min(merged['smooth']))} to {put(max(merged['smooth']))} of p/q under smooth light, "
           f"{put(min(merged['hard edges']))} to {put(max(merged['hard edges']))} with hard edges")
lobes = {}
for row in rows(t):
    lobes.setdefault((row["lobes"], row["set"], row["light"]), {})[row["method"]] = float(row["rmse"])
line(page, f"below MIS in {put(sum(of['OSWA'] < of['MIS'] for of in lobes.values()))} of {put(len(lobes))}")
t = "marques-2018-coats"
merged = {light: [float(row["over_plain"]) for row in rows(t, light=light, method="OSWA")] for light in ("smooth", "hard edges")}
line(page, f"RMSE of images {put(min(merged['smooth']))} to {put(max(merged['smooth']))} of p/q under smooth light, "
           f"{put(min(merged['hard edges']))} to {put(max(merged['hard edges']))} with hard edges")
t = "marques-2018-learned"
learned = [float(row["over_fixed"]) for row in rows(t, light="smooth", way="s learned")]
places = [[float(row["over_fixed"]) for row in rows(t, way="half placed by spread", set=s)] for s in ("random", lambda text: text != "random")]
line(page, f"s: RMSE {put(min(learned))} to {put(max(learned))} under smooth light")
line(page, f"places: {put(min(places[0]))} to {put(max(places[0]))} of random points', up to {put(max(places[1]))} of others'")
t = "marques-2018-joint"
less = [100 * (1 - float(row["over_dense"])) for row in rows(t, points="points and weights")]
line(page, f"| {put(min(less))} to {put(max(less))} % smaller worst-case error than optimal density and weights")
t = "marques-2018-metal"
less = [cell(t, "{over_ratio*-1} % ({over_high*-1} to {over_low*-1})", light="indirect", set=s, weights="osw") for s in ("spherical-fibonacci", "sobol")]
line(page, f"the RMSE falls by {less[0]} and {less[1]}")

# --- Marques 2019
page = "marques-2019.md"
t = "marques-2019-adaptive"
for lobe in ("diffuse", "glossy"):
    block = []
    for criterion in ("entropy", "entropy-brightness", "entropy-histogram", "variance"):
        where = {"lobe": lobe, "criterion": criterion}
        shares = ", ".join(value(t, "measured", 100, what=f"share of level {k}", **where) for k in (1, 2, 3))
        fitted = rows(f"{t}/ways", set="esfg", levels=2, **where)[0]["threshold"]
        block.append(f"| | `{criterion}` | {shares} | " + cell(
            f"{t}/ways", "{saved_of_last_level*100} % | {rmse_over_last_level} | {over_fixed} ({over_fixed_low} to {over_fixed_high})",
            set="esfg", levels=2, threshold=fitted, **where) + " |")
    published = [float(row["published"]) for row in rows(t, lobe=lobe, criterion="entropy", what=lambda text: text.startswith("share"))]
    line(page, f"| {lobe} | published | " + ", ".join(put(100 * p) for p in published) + "\n".join([" | 70.5 % | | |" if lobe == "diffuse" else " | 53.6 % | | |", *block]))
for begin, set_, criterion, factor, threshold in (("`entropy`, 4 times x2, 0.3", "esfg", "entropy", 2, 0.3), ("`variance`, 2 times x4, 0.03", "esfg", "variance", 4, 0.03),
                                                  ("`variance`, 2 times x4, 0.03, Sobol", "sobol", "variance", 4, 0.03),
                                                  ("the same, Faure in base 3", "faure:base=3", "variance", 4, 0.03),
                                                  ("`variance`, 4 times x2, 0.02", "esfg", "variance", 2, 0.02)):
    line(page, f"| {begin} | " + " | ".join(
        cell("marques-2019-adaptive/ways", "{over_fixed} ({over_fixed_low} to {over_fixed_high})", lobe=lobe, set=set_, criterion=criterion,
             factor=factor, threshold=threshold) for lobe in ("diffuse", "glossy")) + " |")
t = "marques-2019-shifts"
for base in (8, 20, 33, 64, 100):
    last = max(float(row["points"]) for row in rows(t, base=base))
    most = [max(float(row[c]) for row in rows(t, base=base, step=step) if float(row["points"]) < last)
            for step, c in (("x2", "paper"), ("x2", "best"), ("x4", "best"), ("x4", "per_level"))]
    line(page, f"| {base} | " + " | ".join(put(m) for m in most) + " |")
t = "marques-2019-statue"


def percent(column, **where):
    mean, low, high = (value("marques-2019-statue", column + end, 100, -100, **where) for end in ("", "_low", "_high"))
    return f"{mean} ({low} to {high})"


ESFG = "esfg:base=8,levels=3,first-shift=paper"
line(page, "| fig. 10, 128 + 32 directions | " + " | ".join(
    percent("over_sf", figure=10, set=s) for s in (ESFG.replace("levels=3", "levels=2"), "sobol", "faure", "faure:base=3")) + " |")
SETS = (ESFG, "sobol", "faure", "faure:base=3")
for lobe in ("diffuse", "glossy"):
    for begin, sizes in ((f"{lobe}, 32 / 128 / 512", (32, 128, 512)), (f"{lobe}, doubled: 16 / 64 / 256", (16, 64, 256))):
        line(page, f"| {begin} | " + " | ".join(
            " / ".join(value(t, "over_sf", 100, -100, figure=11, lobe=lobe, set=s, directions=n) for n in sizes) for s in SETS) + " |")

# --- Schretter 2012
page = "schretter-2012.md"
PLANE = ("golden-set", "fibonacci-lattice", "hammersley", "halton", "blue-noise", "random")
for n in (10, 64, 100, 1000):
    line(page, f"| {n} | " + " | ".join(cell("schretter-2012-sets", "{star_n}", set=s, points=n) for s in PLANE) + " |")
for density in ("ramp", "two Gaussians"):
    line(page, f"| {density} | " + " | ".join(
        cell("schretter-2012-warp", "{difference_n}", density=density, set=s, points=512) for s in ("golden-set", "hammersley", "blue-noise", "random")) + " |")
for n in (64, 16):
    line(page, f"| {n} | " + " | ".join(
        cell("schretter-2012-fig5", "{rmse} ({rmse_low} to {rmse_high})", pattern=s, samples=n, randomised="pixel")
        for s in ("random", "hammersley", "blue-noise", "golden-set", "spherical-fibonacci")) + " |")

# --- other pages
page = "../domains.md"
t = "domains-axes"
more = [value(t, "percent_more", set="electrostatic", of=60, first=1, axes=n) for n in (6, 15, 30, 50)]
line(page, f"have {more[0]}, {more[1]}, {more[2]} and {more[3]} % more energy")
line(page, "Mean energy times n^(3/4): " + ", ".join(f"`{set_}` " + cell("domains-every-number", "{mean}", set=set_)
                                                     for set_ in ("greedy", "r2", "esfg:base=16", "halton", "sobol")))
t = "domains-lifts"
block = []
for name, lift, sizes in (("`super-fibonacci-grid:base=128`", "super-fibonacci-grid", (1024, 8192)),
                          ("`esfg-rotations` (960, 7680)", "esfg-rotations, 20 times 6", (960, 7680)), ("`sobol`", "sobol", (1024, 8192))):
    block.append(f"| {name} | " + " | ".join(cell(t, "{energy_over}, {min_angle_over}, {covering_over}", lift=lift, rotations=n) for n in sizes) + " |")
line(page, "\n".join(block))
page = "../choosing.md"
for set_ in ("random", "spherical-fibonacci"):
    for light in ("smooth", "clipped", "discontinuous"):
        line(page, f"| {set_} | {light} | " + (
            cell("weights-choosing", "{equal} | {optimal} | {optimal_3.5} | {voronoi} | {exact}", set=set_, n=256, integrand=light)) + " |")
page = "../view-factors.md"
held = [100 * float(row["held"]) for row in rows("factors-coverage") if row["case"] != "pooled"]
line(page, f"held in {value('factors-coverage', 'held', 100, case='pooled')} % of 1,000 seeds, over eight cases ({put(min(held))} to {put(max(held))} %)")
page = "../lighting-accuracy.md"
t = "irradiance-coverage"


def is_target(text):
    return float(text) > 0


for name, case in (("closed room, all light from everywhere | 1 %", "furnace"), ("lamp behind half a screen | .1 %", "screen"),
                   ("uniform sky next to a wall | .5 %", "wall"), ("Cornell box | 2 %", "cornell-box"), ("functional of `aur_estimate` | .5 %", "functional")):
    line(page, f"| {name} | {value(t, 'held', 100, case=case, target=0)} % | {value(t, 'held', 100, case=case, target=is_target)} % | "
               f"{value(t, 'directions', case=case, target=is_target)} |")
line(page, f"| pooled | | {value(t, 'held', 100, case='pooled')} % | {value(t, 'held', 100, case='pooled to errors')} % | |")
t = "image-coverage"
held = [value(t, "held", 100, case="image's error", target=target) for target in (0, 0.08)]
nets = value(t, "held", 100, case="discrepancy of scrambled nets")
line(page, f"radiosities ({value('factors-coverage', 'held', 100, case='pooled')} %), and `aureole lab run image-coverage` for the errors that "
           f"`aureole render --error` prints ({held[0]} %; stopped by an error of 8 %: {held[1]} %) and for `aureole measure --seeds 8` ({nets} %)")
