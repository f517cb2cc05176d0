from typing import Any, Optional, Union

from scipy.stats import qmc as _qmc

from ._bridge import Seed
from ._points import Array
from ._tables import Set

class Engine(_qmc.QMCEngine):
    row: Set
    def __init__(
        self,
        d: int = ...,
        *,
        n: Optional[int] = ...,
        scramble: Union[bool, str] = ...,
        optimization: Optional[str] = ...,
        seed: Seed = ...,
        rng: Seed = ...,
        **keys: Any,
    ) -> None: ...
    def fast_forward(self, n: int) -> Engine: ...
    def random_base2(self, m: int) -> Array: ...

def engines() -> dict[str, type[Engine]]: ...

# The engines are made from the table of sets.
def __getattr__(name: str) -> type[Engine]: ...
