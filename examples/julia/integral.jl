# Aureole from Julia: an integral over the cube by 16 randomisations of one Sobol' net, with its standard error.
#
#     AUREOLE=build/release/libaureole.so julia examples/julia/integral.jl
#
# The declarations are those of aureole/core.h and aureole/pointset.h. A struct of options begins with its size, by which the library knows
# the version that it was declared from, and aur_..._init fills it.
const aureole = get(ENV, "AUREOLE", "libaureole")

struct AurError
    result::Cint
    line::Csize_t
    column::Csize_t
    file::NTuple{1024,UInt8}
    message::NTuple{1024,UInt8}
end

mutable struct AurPointsetOptions
    size::Csize_t
    count::UInt64
    dimension::Csize_t
    scramble::Cint
    seed::UInt64
    warning::Ptr{Cvoid}
    warning_user::Ptr{Cvoid}
    AurPointsetOptions() = new(sizeof(AurPointsetOptions), 0, 0, 0, 0, C_NULL, C_NULL)
end

"Calls a function whose last argument is an error, which becomes an exception."
function checked(call)
    storage = Ref{AurError}()
    if call(storage) != 0
        message = collect(storage[].message)
        error(String(message[1:findfirst(iszero, message)-1]))
    end
end

"A set made ready: any part of it, from any thread."
mutable struct Points
    set::Ptr{Cvoid}
    dimension::Int
    function Points(set, count, dimension; scramble="none", seed=0)
        options = AurPointsetOptions()
        checked(e -> @ccall aureole.aur_pointset_options_init(count::UInt64, options::Ref{AurPointsetOptions}, e::Ptr{AurError})::Cint)
        word = Ref{Cint}()
        checked(e -> @ccall aureole.aur_scramble_from_name(scramble::Cstring, word::Ref{Cint}, e::Ptr{AurError})::Cint)
        options.scramble, options.dimension, options.seed = word[], dimension, seed
        made = Ref{Ptr{Cvoid}}()
        checked(e -> @ccall aureole.aur_pointset_create(set::Cstring, options::Ref{AurPointsetOptions}, made::Ref{Ptr{Cvoid}},
                                                        e::Ptr{AurError})::Cint)
        finalizer(p -> @ccall(aureole.aur_pointset_destroy(p.set::Ptr{Cvoid})::Cvoid), new(made[], dimension))
    end
end

"Points first, first + 1, ... counted from 0, one a column."
function part(points, first, count)
    found = Matrix{Float64}(undef, points.dimension, count)
    GC.@preserve points checked(e -> @ccall aureole.aur_pointset_points(
        points.set::Ptr{Cvoid}, first::UInt64, count::Csize_t, length(found)::Csize_t, found::Ptr{Float64}, e::Ptr{AurError})::Cint)
    found
end

n, dimension, turns = 4096, 4, 16
f(x) = prod(@. pi / 2 * sin(pi * x))
means = [sum(f, eachcol(part(Points("sobol", n, dimension; scramble="owen", seed), 0, n))) / n for seed in 0:turns-1]
mean = sum(means) / turns
println("integral ", round(mean, digits=9), " error ", sqrt(sum(abs2, means .- mean) / (turns * (turns - 1))), " exact 1")
println("point 7 of seed 3: ", vec(part(Points("sobol", n, dimension; scramble="owen", seed=3), 7, 1)))
try
    Points("sobl", n, dimension)
catch problem
    println("a wrong name: ", problem.msg)
end
