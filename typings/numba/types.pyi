class Signature: ...

class Type:
    def __call__(self, *arguments: Type) -> Signature: ...

class CPointer(Type):
    def __init__(self, item: Type) -> None: ...

float64: Type
int32: Type
int64: Type
uint8: Type
uint16: Type
uint32: Type
