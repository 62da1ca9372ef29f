# Names of the package: __init__.py loads each at its first use.
from types import ModuleType

from . import dataset as dataset
from . import plot as plot
from . import session as session
from .results import MOVER as MOVER
from .results import PATCH_ORDER as PATCH_ORDER
from .results import Radar as Radar
from .results import Recording as Recording
from .results import Scene as Scene
from .results import Terrain as Terrain
from .results import Patch as Patch
from .results import Scan as Scan
from .results import trade as trade
from .session import CursorFunction as CursorFunction
from .session import Event as Event
from .session import Master as Master
from .session import Mode as Mode
from .session import ModelFlags as ModelFlags
from .session import Navigator as Navigator
from .session import NavFlags as NavFlags
from .session import OwnshipFlags as OwnshipFlags
from .session import PointKind as PointKind
from .session import Power as Power
from .session import RadarFlags as RadarFlags
from .session import Recall as Recall
from .session import Record as Record
from .session import ScanWidth as ScanWidth
from .session import Session as Session
from .session import SteeringCommand as SteeringCommand
from .session import SteeringLine as SteeringLine
from .session import SweepFlags as SweepFlags
from .session import UnknownField as UnknownField
from .session import YarsError as YarsError
from .session import patch_map as patch_map

def _require(name: str, purpose: str) -> ModuleType: ...

__version__: str

class Error(RuntimeError): ...
class MissingPart(Error, ImportError): ...
