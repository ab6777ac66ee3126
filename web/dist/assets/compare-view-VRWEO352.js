import{h as i}from"./chunk-GYUW27G2.js";function r({ids:n}){return i("h1",{children:n})}export{r as CompareView};
